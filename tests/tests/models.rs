//! The bunny's graph furs any clean model.

use pelage_mesh::Summary;
use pelage_tests::{Error, Scene, clean_models};

#[test]
fn every_clean_model_is_furred_from_the_bunnys_graph() -> Result<(), Error> {
    let Some(models) = clean_models()? else {
        println!("PELAGE_MODELS is not set: the models beside the project are left out");
        return Ok(());
    };
    let mut failures = Vec::new();
    for model in models {
        if let Err(error) = furred(&model.display().to_string()) {
            failures.push(format!("{}: {error}", model.display()));
        }
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n").into()) }
}

fn furred(model: &str) -> Result<(), Error> {
    let scene = Scene::evaluate("bunny", &[("bunny.path", model), ("picture.size", "(320, 240)")])?;
    let (mesh, tiling) = (scene.mesh()?, scene.tiling()?);
    let quality = tiling.quality(&mesh, None);
    if quality.faces_covered != Summary::of(&mesh).faces || quality.faces_flipped > 0 || !quality.all_discs {
        return Err(format!("not tiled: {quality:?}").into());
    }
    let picture = scene.picture()?;
    let covered = picture.coverage.iter().filter(|&&c| c > 200).count() as f64 / picture.coverage.len() as f64;
    if !(0.03..0.9).contains(&covered) {
        return Err(format!("{:.1} % of the picture is covered", 100.0 * covered).into());
    }
    Ok(())
}
