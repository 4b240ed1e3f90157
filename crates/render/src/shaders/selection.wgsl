// How many items there are to pick from, and in how many groups.

struct Selection {
    items: u32,
    groups: u32,
    unused: vec2u,
};
