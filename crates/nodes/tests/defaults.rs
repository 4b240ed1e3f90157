//! A node's defaults are its crate's: nobody keeps the two lists alike by hand without being told where they part.

use std::error::Error;
use std::sync::Arc;

use glam::DVec3;
use pelage_graph::{Evaluator, Graph, Request};

fn made_by<T: Send + Sync + 'static>(nodes: &str, output: &str) -> Result<Arc<T>, Box<dyn Error>> {
    let checked = Graph::parse(&format!("Graph(version: 1, nodes: {{{nodes}}})"))?.check(&pelage_nodes::registry())?;
    Ok(Evaluator::new(1 << 28).run(&checked, &Request::output(output))?.get::<T>(output)?)
}

#[test]
fn hair() -> Result<(), Box<dyn Error>> {
    let node = made_by::<pelage_strand::StrandTile>(r#""hair": GrowStrands()"#, "hair.strands")?;
    let library = pelage_strand::grow(&pelage_strand::GrowSettings::default())?;
    assert_eq!(node.strand_count(), library.strand_count());
    for (ours, theirs) in node.strands().zip(library.strands()) {
        assert_eq!((ours.points, ours.radii), (theirs.points, theirs.radii));
        // Picked in sRGB to three places.
        let apart = ours
            .tip_colour
            .iter()
            .zip(theirs.tip_colour)
            .chain(ours.root_colour.iter().zip(theirs.root_colour))
            .map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f32::max) < 3e-3, "{:?} {:?}", ours.tip_colour, theirs.tip_colour);
    }
    Ok(())
}

#[test]
fn textures() -> Result<(), Box<dyn Error>> {
    const HAIR: &str = r#""hair": GrowStrands(count: 80, undercoat: (count: 80)), "#;
    let strands = made_by::<pelage_strand::StrandTile>(HAIR, "hair.strands")?;
    let shells =
        made_by::<pelage_coat::ShellTexture>(&format!("{HAIR}{}", r#""shells": SampleShells(strands: "hair.strands")"#), "shells.shells")?;
    let library = pelage_volume::sample_shells(&strands, &pelage_volume::ShellSettings::default())?;
    assert_eq!(shells.layers(), library.layers());
    let coverage = |texels: &[u8]| texels.iter().skip(3).step_by(4).copied().collect::<Vec<u8>>();
    for (ours, theirs) in shells.mips.iter().zip(&library.mips) {
        assert!(coverage(&ours.texels) == coverage(&theirs.texels), "coverage differs at {} texels", ours.width);
    }
    let fin = made_by::<pelage_coat::FinTexture>(&format!("{HAIR}{}", r#""fin": SampleFin(strands: "hair.strands")"#), "fin.fin")?;
    let library = pelage_volume::sample_fin(&strands, &pelage_volume::FinSettings::default())?;
    assert!(fin.mips.iter().map(|m| &m.texels).eq(library.mips.iter().map(|m| &m.texels)));
    Ok(())
}

#[test]
fn patches() -> Result<(), Box<dyn Error>> {
    const BALL: &str = r#""ball": Sphere(), "patches": GrowPatches(mesh: "ball.mesh")"#;
    let mesh = made_by::<pelage_mesh::Mesh>(BALL, "ball.mesh")?;
    let node = made_by::<pelage_patch::PatchTiling>(BALL, "patches.patches")?;
    let settings = pelage_patch::Settings { seed: 1, ..pelage_patch::Settings::for_mesh(&mesh) };
    assert_eq!(*node, pelage_patch::grow(&mesh, None, &settings)?);
    Ok(())
}

/// A field by constraints and points is the library's, and a whirl in a file is one on the surface.
#[test]
fn constraints_and_points() -> Result<(), Box<dyn Error>> {
    const BALL: &str = r#""ball": Sphere(), "combed": DirectionField(mesh: "ball.mesh", reach: 0.1,
        constraints: [(at: (0.5, 0.0, 0.0), along: (0.0, -1.0, 0.0))],
        points: [(at: (0.0, 0.5, 0.0), flow: Turned(turn: 90.0)), (at: (0.0, 0.0, 0.5), flow: Saddle(along: (1.0, 0.0, 0.0)))])"#;
    let mesh = made_by::<pelage_mesh::Mesh>(BALL, "ball.mesh")?;
    let node = made_by::<pelage_field::DirectionField>(BALL, "combed.directions")?;
    let vectors = [pelage_field::Constraint { at: 0.5 * DVec3::X, along: DVec3::NEG_Y }];
    let points = [
        pelage_field::PointConstraint { at: 0.5 * DVec3::Y, flow: pelage_field::Flow::Turned(90_f64.to_radians()) },
        pelage_field::PointConstraint { at: 0.5 * DVec3::Z, flow: pelage_field::Flow::Saddle(DVec3::X) },
    ];
    assert_eq!(*node, pelage_field::DirectionField::from_constraints(&mesh, &vectors, &points, 0.1)?);
    let found = pelage_field::singularities(&mesh, &node)?;
    for (place, index) in [(DVec3::Y, 1), (DVec3::Z, -1)] {
        let edge = mesh.mean_edge_length() / mesh.diameter();
        let near = |s: &&pelage_field::Singularity| mesh.face(s.face).centre().normalize().distance(place) < 4.0 * edge;
        assert_eq!(found.iter().filter(near).map(|s| s.index).collect::<Vec<_>>(), [index]);
    }
    Ok(())
}
