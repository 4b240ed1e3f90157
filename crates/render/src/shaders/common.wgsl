// What every pass shares: the frame, the skin's vertices, packing. Mirrors uniforms.rs and pack.rs.

struct Light {
    direction: vec4f,  // L; w unused
    colour: vec4f,     // w unused
};

struct Frame {
    clip_from_coat: mat4x4f,
    eye: vec4f,           // w unused
    toward_eye: vec4f,    // the viewer at infinity; how far one level of detail has become the next, 0 … 1
    lights: array<Light, 4>,
    irradiance: array<vec4f, 9>,  // coefficients of 1, y, z, x, xy, yz, 3z² − 1, xz, x² − y² of the normal
    ambient: vec4f,       // Ka; w unused
    diffuse: vec4f,       // Kd, Pd / 2
    specular: vec4f,      // Ks, Ps / 2
    shadow: vec4f,        // density, minimum, grazing, density seen by the hemisphere
    facing: vec4f,        // strength, dark_below, 1 / (full_above − dark_below); how strong shadows between hairs are
    fur: vec4f,           // length scale, layers per unit of height, alpha threshold, growth per diameter of length
    screen: vec4f,        // half the width and height in pixels, most levels of blur between layers; steps of a march for each layer
    table: vec4f,         // (size − 1) / size, 0.5 / size, u by angle, v by angle
    fins: vec4f,          // rule, threshold, segments, opacity
    light_from_coat: mat4x4f,  // the first light's view
    mixes: vec4f,         // images of a mixture of hair, how many mixtures follow the first; unused
    casting: vec4f,       // the fur's length in that view's depth, shells that one that casts stands for, a bias in diameters; layers that a shell shows
};

// A shell: mirrors schedule.rs. Of two numbers in one word the upper is that of the level of detail which this one becomes.
struct Shell {
    height: f32,
    light_height: f32,
    step: f32,         // to the next shell, in heights
    images: u32,       // of the stack and of the direction map
    above: u32,        // the shell that shades it
    opacity: f32,      // multiplies α; then
    layers: f32,       // α becomes 1 − (1 − α)^layers
    later_opacity: f32,
    later_layers: f32,
    top: f32,          // where it is drawn: at its height, unless it marches while levels of detail blend
    top_light: f32,
    bottom: f32,       // the lowest layer that it shows
    bottom_light: f32,
    asked: f32,        // 0 where a march is to pass it over
    unused: vec2f,
};

struct Vertex {
    position: vec3f,
    normal: vec3f,
    offset: vec3f,     // scaled
    bend: vec3f,       // scaled
    direction: vec3f,
    colour: vec3f,
    end: f32,
    mix: f32,          // between the first mixture of hair and the last
};

#if INSTANCED
// Where one of a crowd stands: the rows of the matrix from the coat to the world, which turns, moves and scales evenly. Mirrors crowd.rs.
struct Place {
    x: vec4f,
    y: vec4f,
    z: vec4f,
};

// Which of the places a vertex belongs to; set first by the vertex shaders.
var<private> place_number: u32;

fn in_world(v: vec4f) -> vec3f {
    let place = places[place_number];
    return vec3f(dot(place.x, v), dot(place.y, v), dot(place.z, v));
}

fn size_in_world() -> f32 {
    // A place of no size shows nothing, without dividing by it.
    return max(length(places[place_number].x.xyz), 1e-30);
}
#endif

// A unit vector from a place on the unfolded octahedron.
fn folded(e: vec2f) -> vec3f {
    let z = 1.0 - abs(e.x) - abs(e.y);
    let fold = max(-z, 0.0);
    return normalize(vec3f(e - select(vec2f(-fold), vec2f(fold), e >= vec2f(0.0)), z));
}

fn unpack_direction(packed: u32) -> vec3f {
    return folded(unpack2x16snorm(packed));
}

// A mean of directions, its length in the top byte.
fn unpack_mean_direction(packed: u32) -> vec3f {
    let e = vec2f(f32(bitcast<i32>(packed << 20u) >> 20u), f32(bitcast<i32>(packed << 8u) >> 20u)) / 2047.0;
    return folded(max(e, vec2f(-1.0))) * (f32(packed >> 24u) / 255.0);
}

fn vertex_at(index: u32) -> Vertex {
    let s = skin[index];
    let f = fur[index];
    let l = looks[index];
    let blue_end = unpack2x16float(l.y);
    let bend_mix = unpack2x16float(l.w);
    let v = Vertex(
        bitcast<vec3f>(s.xyz),
        unpack_direction(s.w),
        bitcast<vec3f>(f.xyz) * frame.fur.x,
        vec3f(unpack2x16float(l.z), bend_mix.x) * frame.fur.x,
        unpack_mean_direction(f.w),
        vec3f(unpack2x16float(l.x), blue_end.x),
        blue_end.y,
        bend_mix.y,
    );
#if INSTANCED
    // The frame is that of the world.
    return Vertex(
        in_world(vec4f(v.position, 1.0)),
        in_world(vec4f(v.normal, 0.0)) / size_in_world(),
        in_world(vec4f(v.offset, 0.0)),
        in_world(vec4f(v.bend, 0.0)),
        in_world(vec4f(v.direction, 0.0)) / size_in_world(),
        v.colour,
        v.end,
        v.mix,
    );
#else
    return v;
#endif
}

// How far from the skin the hair is at a height: c h + b (h² − h).
fn curve(v: Vertex, height: f32) -> vec3f {
#if BENT
    return v.offset * height + v.bend * (height * height - height);
#else
    return v.offset * height;
#endif
}

// Which way it goes there, for a unit of height.
fn slope(v: Vertex, height: f32) -> vec3f {
#if BENT
    return v.offset + v.bend * (2.0 * height - 1.0);
#else
    return v.offset;
#endif
}

// T at a height: the mean, turned as the curve is.
fn direction_at(v: Vertex, height: f32) -> vec3f {
#if BENT
    let size = max(length(v.offset), 1e-20);
    let turned = v.direction + slope(v, height) / max(length(slope(v, height)), 1e-20) - v.offset / size;
    return turned / max(length(turned), 1.0);
#else
    return v.direction;
#endif
}

// How much of its fur a place has, to be clamped to 0 … 1 after interpolation: it comes in over the first thousandth of a diameter of
// length, so that fur without length is no fur and there is no step on the way.
fn growth_of(offset: vec3f) -> f32 {
#if INSTANCED
    return length(offset) * frame.fur.w / size_in_world();
#else
    return length(offset) * frame.fur.w;
#endif
}

// What a cut leaves of the hair at a height, to be clamped to 0 … 1 after interpolation: it ends over one layer.
fn cut_of(end: f32, height: f32) -> f32 {
    return (end - height) * frame.fur.y + 1.0;
}
