//! What was mended, in figures.

use std::fmt;

macro_rules! report {
    ($($(#[doc = $doc:literal])* $field:ident: $words:literal,)*) => {
        /// What [`repair`](crate::repair) did to make a surface of polygons, counted. All zero where there was nothing to mend.
        ///
        /// It displays as one line for each count that is not zero, or as `none`.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct RepairReport {
            $($(#[doc = $doc])* pub $field: usize,)*
        }

        impl RepairReport {
            /// Nothing mended.
            pub const NONE: Self = Self { $($field: 0,)* };

            /// Every count with the name of its field and what it means in a few words, in the order of the repairs.
            pub fn counts(&self) -> [(&'static str, &'static str, usize); [$($words),*].len()] {
                [$((stringify!($field), $words, self.$field)),*]
            }
        }
    };
}

report! {
    /// Vertices that stood where another one stands, and are that one now.
    vertices_welded: "vertices welded to one at the same place",
    /// Faces given with fewer than three corners, dropped.
    faces_with_few_corners: "faces of fewer than three corners dropped",
    /// Faces dropped since fewer than three different corners are left of them.
    faces_collapsed: "faces with repeated corners dropped",
    /// Corners dropped that repeat the one before, in faces that stay.
    corners_repeated: "repeated corners dropped",
    /// Polygons that cross themselves or have no area, which were cut into a fan for want of anything better.
    polygons_tangled: "polygons that cross themselves cut into fans",
    /// Faces dropped that have the corners of another one, whichever way they are wound.
    faces_duplicated: "duplicate faces dropped",
    /// Faces without area that filled a T-junction: the face along their long side is cut in two instead.
    junctions_split: "T-junctions closed",
    /// Other faces without area, dropped.
    faces_without_area: "faces without area dropped",
    /// Edges with more than two faces, which were taken apart into pairs.
    edges_split: "edges with more than two faces taken apart",
    /// Faces wound the other way, so that neighbours agree.
    faces_turned: "faces turned to agree with their neighbours",
    /// Edges opened where a surface with one side only was cut.
    edges_cut: "edges cut open in a surface with one side",
    /// Vertices where pieces of surface touched, without an edge between them; each piece has its own now.
    vertices_split: "vertices where pieces touched taken apart",
    /// Copies of vertices made by taking apart and cutting.
    vertices_added: "vertices added in taking apart and cutting",
    /// Closed pieces that were wound inwards, turned outwards.
    pieces_turned: "closed pieces turned outwards",
    /// Vertices that no face uses, dropped.
    vertices_unreferenced: "vertices without a face dropped",
}

impl RepairReport {
    /// Whether nothing had to be mended.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }
}

impl fmt::Display for RepairReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_none() {
            return f.write_str("none");
        }
        let made = self.counts().into_iter().filter(|&(_, _, count)| count > 0);
        let lines: Vec<String> = made.map(|(_, words, count)| format!("{words}: {count}")).collect();
        f.write_str(&lines.join("\n"))
    }
}
