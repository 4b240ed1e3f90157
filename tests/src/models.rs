//! Models that may be absent from a clone.

use std::path::PathBuf;

use crate::Error;

/// The clean models of `$PELAGE_MODELS/real`: oriented manifolds, so all but the one-sided Möbius strip. `None` where the variable is unset.
///
/// # Errors
/// Where the variable is set and a model is missing.
pub fn clean_models() -> Result<Option<Vec<PathBuf>>, Error> {
    const CLEAN: [&str; 12] = [
        "armadillo",
        "bunny_closed",
        "cat",
        "fertility",
        "hand",
        "spot",
        "t1_bunny_5000",
        "t1_cat_5000",
        "t1_chimp_4910_koala",
        "t1_die_1452",
        "t1_dog_5000_bear",
        "t1_spider_5000_scorpion",
    ];
    let Some(folder) = std::env::var_os("PELAGE_MODELS") else { return Ok(None) };
    let paths: Vec<PathBuf> = CLEAN.iter().map(|name| PathBuf::from(&folder).join(format!("real/{name}.obj"))).collect();
    match paths.iter().find(|path| !path.is_file()) {
        Some(missing) => Err(format!("PELAGE_MODELS is set, but {} is missing", missing.display()).into()),
        None => Ok(Some(paths)),
    }
}
