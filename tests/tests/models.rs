//! The bunny's graph furs any clean model.

use pelage_graph::Evaluator;
use pelage_mesh::Summary;
use pelage_nodes::Picture;
use pelage_tests::{Error, Scene, clean_models};

#[test]
fn every_clean_model_is_furred_from_the_bunnys_graph() -> Result<(), Error> {
    let Some(models) = clean_models()? else {
        println!("PELAGE_MODELS is not set: the models beside the project are left out");
        return Ok(());
    };
    let mut evaluator = pelage_nodes::evaluator(1 << 30);
    let mut failures = Vec::new();
    for model in models {
        if let Err(error) = furred(&mut evaluator, &model.display().to_string()) {
            failures.push(format!("{}: {error}", model.display()));
        }
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n").into()) }
}

/// The part of the picture that skin or fur covers.
fn covered(picture: &Picture) -> f64 {
    picture.coverage.iter().map(|&c| f64::from(c) / 255.0).sum::<f64>() / picture.coverage.len() as f64
}

fn furred(evaluator: &mut Evaluator, model: &str) -> Result<(), Error> {
    let scene = Scene::evaluate_with(evaluator, "bunny", &[("bunny.path", model), ("picture.size", "(320, 240)")])?;
    let (mesh, tiling) = (scene.mesh()?, scene.tiling()?);
    let quality = tiling.quality(&mesh, None);
    if quality.faces_covered != Summary::of(&mesh).faces || quality.faces_flipped > 0 || !quality.all_discs {
        return Err(format!("not tiled: {quality:?}").into());
    }
    let picture = scene.picture()?;
    if picture.frame.shells_drawn == 0 || picture.frame.fins_drawn == 0 {
        return Err(format!("not furred: {:?}", picture.frame).into());
    }
    // Fur stands out from the skin all around.
    let bald = Scene::evaluate_with(
        evaluator,
        "bunny",
        &[("bunny.path", model), ("picture.size", "(320, 240)"), ("picture.length_scale", "0.0")],
    )?
    .picture()?;
    let (covered, bare) = (covered(&picture), covered(&bald));
    if !(0.03..=0.95).contains(&covered) || covered < 1.03 * bare {
        return Err(format!("{:.1} % of the picture is covered, {:.1} % by skin alone", 100.0 * covered, 100.0 * bare).into());
    }
    Ok(())
}
