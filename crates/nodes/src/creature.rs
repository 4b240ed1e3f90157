//! Animals, and fields by the parts of their bodies.

use std::sync::Arc;

use glam::Vec3;
use pelage_creature::{Creature, Part, Species};
use pelage_field::{ColourField, DirectionField, ScalarField};
use pelage_graph::{Colour, Context, Evaluate, Node, NodeError, Param};
use pelage_mesh::Mesh;

use crate::shading::linear;

/// Which animal.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum Animal {
    /// A cat, its tail up.
    Cat,
    /// A dog with hanging ears.
    Dog,
    /// A fox with a bushy tail.
    Fox,
    /// A bear.
    Bear,
    /// A mouse.
    Mouse,
    /// A rabbit.
    Rabbit,
    /// A chimpanzee on all fours, without a tail.
    Chimp,
    /// A spider with eight legs and two eyes.
    Spider,
}

impl From<&Animal> for Species {
    fn from(animal: &Animal) -> Self {
        match animal {
            Animal::Cat => Self::Cat,
            Animal::Dog => Self::Dog,
            Animal::Fox => Self::Fox,
            Animal::Bear => Self::Bear,
            Animal::Mouse => Self::Mouse,
            Animal::Rabbit => Self::Rabbit,
            Animal::Chimp => Self::Chimp,
            Animal::Spider => Self::Spider,
        }
    }
}

/// An animal from smooth implicit shapes: closed, of one piece, with well-shaped faces.
#[derive(Node)]
#[node(category = "Models", version = 2, name = "Creature")]
#[output(mesh: Mesh, "The surface. It looks along +z and stands on y = 0; from chest to rump is 1.")]
#[output(directions: DirectionField, "How fur lies by nature: from the nose to the tail, down the legs, up the ears.")]
#[output(creature: Creature, "The whole, which knows the part that each vertex belongs to.")]
pub struct CreatureNode {
    /// Which animal.
    #[param(default = Animal::Cat)]
    pub species: Animal,
    /// How many triangles; an odd number is met by one less.
    #[param(default = 6000, range = 300..=4000000, unit = "faces", effect = "cost is linear in it; too few for thin parts are refused")]
    pub faces: u32,
    /// How far an individual's proportions may be from those of its kind.
    #[param(default = 0.0, range = 0.0..=0.5, unit = "fraction", effect = "0 is the kind itself")]
    pub variation: f64,
    /// Length of the legs.
    #[param(default = 1.0, range = 0.25..=2.0, unit = "those of the kind", effect = "longer legs")]
    pub legs: f64,
    /// Length of the ears.
    #[param(default = 1.0, range = 0.0..=2.0, unit = "those of the kind", effect = "longer ears; 0 leaves them out")]
    pub ears: f64,
    /// Length of the tail.
    #[param(default = 1.0, range = 0.0..=2.0, unit = "that of the kind", effect = "a longer tail; 0 leaves it out")]
    pub tail: f64,
    /// Radius of chest, belly and rump.
    #[param(default = 1.0, range = 0.5..=1.5, unit = "that of the kind", effect = "a fatter animal")]
    pub girth: f64,
    /// Which individual.
    #[param(default = 1, unit = "seed", effect = "another of its kind, if the variation is not 0")]
    pub seed: u64,
}

impl CreatureNode {
    fn creature(&self) -> Result<Creature, NodeError> {
        let mut plan = Species::from(&self.species).plan().individual(self.seed, self.variation)?;
        for proportion in plan.proportions() {
            let factor = match proportion.name {
                "legs.fore" | "legs.hind" => self.legs,
                "ears.length" => self.ears,
                "tail.length" => self.tail,
                "trunk.chest" | "trunk.belly" | "trunk.rump" => self.girth,
                _ => 1.0,
            };
            *proportion.value = (*proportion.value * factor).clamp(*proportion.range.start(), *proportion.range.end());
        }
        Ok(Creature::new(&plan, self.faces)?)
    }
}

impl Evaluate for CreatureNode {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let creature = self.creature()?;
        let directions = match cx.wants("directions") {
            true => Some(Arc::new(DirectionField::from_vectors(creature.mesh(), &creature.lie())?)),
            false => None,
        };
        Ok(CreatureNodeOutputs {
            mesh: cx.wants("mesh").then(|| Arc::new(creature.mesh().clone())),
            directions,
            creature: Some(Arc::new(creature)),
        })
    }
}

/// A part of an animal's body.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum BodyPart {
    /// Chest, belly and rump.
    Trunk,
    /// The neck.
    Neck,
    /// The head without the muzzle.
    Head,
    /// From the cheeks to the nose.
    Muzzle,
    /// The nose.
    Nose,
    /// Both eyes.
    Eyes,
    /// Both ears.
    Ears,
    /// Thighs and shanks.
    Legs,
    /// What it stands on.
    Paws,
    /// The tail without its tip.
    Tail,
    /// The last quarter of the tail.
    TailTip,
}

impl From<&BodyPart> for Part {
    fn from(part: &BodyPart) -> Self {
        match part {
            BodyPart::Trunk => Self::Trunk,
            BodyPart::Neck => Self::Neck,
            BodyPart::Head => Self::Head,
            BodyPart::Muzzle => Self::Muzzle,
            BodyPart::Nose => Self::Nose,
            BodyPart::Eyes => Self::Eyes,
            BodyPart::Ears => Self::Ears,
            BodyPart::Legs => Self::Legs,
            BodyPart::Paws => Self::Paws,
            BodyPart::Tail => Self::Tail,
            BodyPart::TailTip => Self::TailTip,
        }
    }
}

/// How the fur of one part is.
#[derive(Clone, Debug, PartialEq, Param)]
pub struct PartFur {
    /// The part.
    #[param(default = BodyPart::Trunk)]
    pub part: BodyPart,
    /// Its colour, which multiplies the hair's own.
    #[param(default = Colour([1.0, 1.0, 1.0]))]
    pub colour: Colour,
    /// Its length, as a factor; 0 is bare.
    #[param(default = 1.0, range = 0.0..=10.0, unit = "factor", effect = "longer fur there")]
    pub length: f64,
    /// Which of the coats in a row it has.
    #[param(default = 0.0, range = 0.0..=255.0, unit = "places in the row", effect = "0: the first, 1: the second; between, some hair of either")]
    pub coat: f64,
}

/// Colour, length and kind of the fur by the parts of an animal's body (L18, L19, L24).
#[derive(Node)]
#[node(category = "Fields", version = 2)]
#[output(colours: ColourField, "A colour for each vertex.")]
#[output(lengths: ScalarField, "A factor of the length for each vertex.")]
#[output(coats: ScalarField, "Which of the coats in a row for each vertex.")]
pub struct PartFields {
    /// The animal.
    #[input]
    pub creature: Arc<Creature>,
    /// The parts that have fur of their own.
    #[param(default = Vec::new())]
    pub parts: Vec<PartFur>,
    /// Colour of all the others.
    #[param(default = Colour([1.0, 1.0, 1.0]))]
    pub colour: Colour,
    /// Length of all the others, as a factor.
    #[param(default = 1.0, range = 0.0..=10.0, unit = "factor", effect = "longer fur")]
    pub length: f64,
    /// Which of the coats in a row all the others have.
    #[param(default = 0.0, range = 0.0..=255.0, unit = "places in the row", effect = "0: the first, 1: the second; between, some hair of either")]
    pub coat: f64,
    /// Width of the passage from part to part.
    #[param(default = 0.04, range = 0.001..=1.0, unit = "body lengths", effect = "softer borders")]
    pub softness: f64,
}

impl Evaluate for PartFields {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        for (index, fur) in self.parts.iter().enumerate() {
            if self.parts[..index].iter().any(|earlier| earlier.part == fur.part) {
                return Err(format!("parts: {:?} is given twice; leave one of them out", fur.part).into());
            }
        }
        let count = self.creature.mesh().positions().len();
        let (base, long, first) = (linear(self.colour), self.length as f32, self.coat as f32);
        let (mut colours, mut lengths, mut coats) = (vec![base; count], vec![long; count], vec![first; count]);
        for fur in &self.parts {
            let (colour, length, coat): (Vec3, f32, f32) = (linear(fur.colour), fur.length as f32, fur.coat as f32);
            let weights = self.creature.weights(Part::from(&fur.part), self.softness)?;
            for (vertex, weight) in weights.into_iter().enumerate().map(|(vertex, weight)| (vertex, weight as f32)) {
                colours[vertex] += weight * (colour - base);
                lengths[vertex] += weight * (length - long);
                coats[vertex] += weight * (coat - first);
            }
        }
        Ok(PartFieldsOutputs {
            colours: Some(Arc::new(ColourField::new(colours.into_iter().map(|colour| colour.max(Vec3::ZERO)).collect())?)),
            lengths: Some(Arc::new(ScalarField::new(lengths.into_iter().map(|length| length.max(0.0)).collect())?)),
            coats: Some(Arc::new(ScalarField::new(coats)?)),
        })
    }
}
