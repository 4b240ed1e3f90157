//! The list of all nodes, and an engine that can run them.

use pelage_coat::{Coat, FinTexture, Lights, ShellTexture};
use pelage_creature::Creature;
use pelage_field::{ColourField, DirectionField, ScalarField};
use pelage_graph::{Evaluator, Registry};
use pelage_lighting::Shading;
use pelage_mesh::{Mesh, RepairReport};
use pelage_patch::{LappedPatches, PatchTiling};
use pelage_reference::Curves;
use pelage_strand::StrandTile;

use crate::Framing;

/// Every node and every type that runs along a link.
pub fn registry() -> Registry {
    let registry = Registry::new()
        .value::<Mesh>("Mesh", Mesh::byte_size)
        .value::<Creature>("Creature", |creature| creature.mesh().byte_size())
        .value::<RepairReport>("RepairReport", |_| size_of::<RepairReport>())
        .value::<DirectionField>("DirectionField", |field| size_of_val(field.vectors()))
        .value::<ScalarField>("ScalarField", |field| size_of_val(field.values()))
        .value::<ColourField>("ColourField", |field| size_of_val(field.values()))
        .value::<PatchTiling>("PatchTiling", PatchTiling::byte_size)
        .value::<LappedPatches>("LappedPatches", LappedPatches::byte_size)
        .value::<StrandTile>("StrandTile", StrandTile::byte_size)
        .value::<ShellTexture>("ShellTexture", |shells| shells.byte_size() + shells.direction_bytes())
        .value::<crate::CurlReport>("CurlReport", |_| size_of::<crate::CurlReport>())
        .value::<crate::OneLayerReport>("OneLayerReport", |_| size_of::<crate::OneLayerReport>())
        .value::<FinTexture>("FinTexture", FinTexture::byte_size)
        .value::<Coat>("Coat", Coat::byte_size)
        .value::<Curves>("Curves", Curves::byte_size)
        .value::<Framing>("Framing", |_| size_of::<Framing>())
        .value::<Lights>("Lights", |lights| size_of::<Lights>() + size_of_val(&lights.directional[..]))
        .value::<Shading>("Shading", |_| size_of::<Shading>())
        .node::<crate::ObjFile>()
        .node::<crate::GltfFile>()
        .node::<crate::Plane>()
        .node::<crate::Sphere>()
        .node::<crate::Torus>()
        .node::<crate::RoundedDie>()
        .node::<crate::CreatureNode>()
        .node::<crate::Subdivide>()
        .node::<crate::Simplify>()
        .node::<crate::Transform>()
        .node::<crate::Join>()
        .node::<crate::DirectionFieldNode>()
        .node::<crate::ConstantField>()
        .node::<crate::ScalarRamp>()
        .node::<crate::NoiseField>()
        .node::<crate::StrokeField>()
        .node::<crate::FieldMath>()
        .node::<crate::RemapField>()
        .node::<crate::MaskField>()
        .node::<crate::BlurField>()
        .node::<crate::ColourRamp>()
        .node::<crate::MixColours>()
        .node::<crate::BlurColours>()
        .node::<crate::ColourAmount>()
        .node::<crate::VertexColours>()
        .node::<crate::ImageField>()
        .node::<crate::PartFields>()
        .node::<crate::CombStrokes>()
        .node::<crate::GrowPatches>()
        .node::<crate::LapPatches>()
        .node::<crate::GrowStrands>()
        .node::<crate::GuideStrands>()
        .node::<crate::MixStrands>()
        .node::<crate::CoatsInARow>()
        .node::<crate::SampleShells>()
        .node::<crate::PatternShells>()
        .node::<crate::ImageShells>()
        .node::<crate::TintShells>()
        .node::<crate::LevelsOfDetail>()
        .node::<crate::ShareImages>()
        .node::<crate::OneLayer>()
        .node::<crate::CompressShells>()
        .node::<crate::SampleFin>()
        .node::<crate::FinOfShells>()
        .node::<crate::FinImage>()
        .node::<crate::LayFur>()
        .node::<crate::HairLightingNode>()
        .node::<crate::LightNode>()
        .node::<crate::EnvironmentNode>()
        .node::<crate::CameraNode>()
        .node::<crate::StrandCurves>();
    with_drawing(registry)
}

/// An engine with a cache of `budget` bytes that makes a graphics device when a node first asks for one.
pub fn evaluator(budget: usize) -> Evaluator {
    let evaluator = Evaluator::new(budget);
    #[cfg(feature = "gpu")]
    let evaluator =
        evaluator.resource(crate::Gpu::new).context_value("adapter", |resources| Ok(resources.get::<crate::Gpu>()?.description().into()));
    evaluator
}

#[cfg(feature = "gpu")]
fn with_drawing(registry: Registry) -> Registry {
    use pelage_render::Picture;
    registry
        .value::<Picture>("Picture", |picture| picture.rgba.len() + picture.coverage.len())
        .value::<crate::FrameReport>("FrameReport", |_| size_of::<crate::FrameReport>())
        .value::<crate::RayReport>("RayReport", |_| size_of::<crate::RayReport>())
        .value::<crate::Quality>("Quality", |_| size_of::<crate::Quality>())
        .node::<crate::Budget>()
        .node::<crate::RenderImage>()
        .node::<crate::ReferenceImage>()
        .node::<crate::SideBySide>()
}

#[cfg(not(feature = "gpu"))]
fn with_drawing(registry: Registry) -> Registry {
    registry
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_specification_is_documented_has_units_and_defaults_in_range() {
        super::registry().validate().unwrap();
    }
}
