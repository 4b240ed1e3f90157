//! Animals for fur: from a plan in proportions to a closed, clean triangle mesh of any number of faces.
//!
//! A [`Plan`] says how long the legs are and how bushy the tail; [`Species`] keeps some of known animals, [`Plan::individual`] varies one by a seed. A [`Creature`] is
//! made of it: smoothly joined implicit limbs, meshed by the library `transvoxel`, then thinned to the very number of faces and evened out. It also knows which part of the body a
//! vertex belongs to ([`Creature::weights`]) and which way fur lies there by nature ([`Creature::lie`]).
//!
//! # Convention
//! Lengths are in *body lengths*, from the middle of the chest to the middle of the rump; y is up, the creature looks along +z, its left is at +x, and it stands on y = 0. Results
//! are the same bits for any number of threads. Nothing panics on any plan: what is out of range, or cannot be a ball's surface, is a [`CreatureError`].
//!
//! ```
//! use pelage_creature::{Creature, Part, Species};
//! use pelage_mesh::Summary;
//!
//! let mut plan = Species::Cat.plan().individual(7, 0.1)?;
//! plan.tail.bush = 2.0;
//! let cat = Creature::new(&plan, 3_000)?;
//! let summary = Summary::of(cat.mesh());
//! assert_eq!((summary.faces, summary.components, summary.genus), (3_000, 1, 0));
//! let nose = cat.weights(Part::Nose, 0.02)?;
//! assert!(nose.iter().any(|&weight| weight > 0.9));
//! # Ok::<(), pelage_creature::CreatureError>(())
//! ```
//!
//! # Sources
//! J. Bloomenthal, K. Shoemake: Convolution Surfaces, SIGGRAPH 1991 (limbs around a skeleton). I. Quilez: Smooth minimum, 2013, and Distance functions, 2008
//! (the join, the round cone). T. Duff: Interval Arithmetic and Recursive Subdivision for Implicit Functions, SIGGRAPH 1992 (which limbs matter in a region).
//! E. Lengyel: Voxel-Based Terrain for Real-Time Virtual Simulations, 2010 (the cases of marching cubes). M. Botsch, L. Kobbelt: A Remeshing Approach to Multiresolution
//! Modeling, SGP 2004 (short edges out, edges flipped, vertices relaxed along the surface). T. K. Dey, H. Edelsbrunner, S. Guha, D. V. Nekhayev: Topology Preserving Edge
//! Contraction, 1999 (which edges may go).

mod anatomy;
mod body;
mod cone;
mod creature;
mod error;
mod individual;
mod legs;
mod part;
mod plan;
mod raw;
mod reduce;
mod relax;
mod skin;
mod species;
mod tail;

pub use creature::{Creature, FEWEST_FACES, MOST_FACES};
pub use error::CreatureError;
pub use part::Part;
pub use plan::{Ears, Head, Limbs, MOST_LEG_PAIRS, Neck, Plan, Proportion, Stance, Tail, Trunk};
pub use species::Species;
