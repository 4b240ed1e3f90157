//! Every dependency's licence is one that deny.toml allows.
//!
//! The same file serves `cargo deny`. Advisories need its database, which has to be fetched: `cargo deny check advisories` checks
//! them where that can be done; nothing here does.

use std::fs;

use cargo_metadata::{CargoOpt, MetadataCommand};
use spdx::{Expression, Licensee, ParseMode};
use toml::{Table, Value};

use crate::failure::{Failure, Result};
use crate::place::Place;

/// What deny.toml allows.
#[derive(Debug, Default)]
struct Policy {
    /// For every package.
    allowed: Vec<Licensee>,
    /// For one package by name, besides.
    exceptions: Vec<(String, Licensee)>,
}

/// A package we build with, and the SPDX expression it states.
struct Licensed {
    name: String,
    version: String,
    licence: Option<String>,
}

/// Checks every package of the lock file, on every platform and with every feature.
pub(crate) fn check(place: &Place) -> Result<()> {
    let file = place.at("deny.toml");
    let text = fs::read_to_string(&file).map_err(|cause| Failure::caused(file.display(), cause))?;
    let policy = policy(&text).map_err(|cause| Failure::caused(file.display(), cause))?;
    let metadata = MetadataCommand::new()
        .manifest_path(place.at("Cargo.toml"))
        .features(CargoOpt::AllFeatures)
        .other_options(["--locked".to_owned()])
        .exec()
        .map_err(|cause| Failure::caused("cargo metadata", cause))?;
    let packages: Vec<Licensed> = metadata
        .packages
        .iter()
        .map(|package| Licensed { name: package.name.to_string(), version: package.version.to_string(), licence: package.license.clone() })
        .collect();
    let faults = faults(&packages, &policy);
    if !faults.is_empty() {
        return Err(Failure::faults("not every licence is allowed", &faults)
            .remedy("choose another library, or allow it in deny.toml if it may be combined with MIT OR Apache-2.0"));
    }
    println!("{} packages, every licence allowed by deny.toml (advisories: `cargo deny check advisories`)", packages.len());
    Ok(())
}

/// The `[licenses]` table: `allow = [LICENCE…]` and `exceptions = [{ name, allow }…]`.
fn policy(text: &str) -> std::result::Result<Policy, String> {
    let table: Table = text.parse().map_err(|cause: toml::de::Error| cause.to_string())?;
    let licenses = table.get("licenses").and_then(Value::as_table).ok_or("there is no [licenses] table")?;
    let mut policy = Policy { allowed: licensees(licenses.get("allow"))?, exceptions: Vec::new() };
    for exception in licenses.get("exceptions").and_then(Value::as_array).into_iter().flatten() {
        let name = exception.get("name").and_then(Value::as_str).ok_or("an exception without a `name`")?;
        policy.exceptions.extend(licensees(exception.get("allow"))?.into_iter().map(|licensee| (name.to_owned(), licensee)));
    }
    Ok(policy)
}

fn licensees(list: Option<&Value>) -> std::result::Result<Vec<Licensee>, String> {
    let list = list.and_then(Value::as_array).ok_or("`allow` is not a list")?;
    list.iter()
        .map(|name| {
            let name = name.as_str().ok_or("a licence in `allow` is not a string")?;
            Licensee::parse(name).map_err(|cause| format!("`{name}`: {}", cause.reason))
        })
        .collect()
}

fn faults(packages: &[Licensed], policy: &Policy) -> Vec<String> {
    packages.iter().filter_map(|package| Some(format!("{} {}: {}", package.name, package.version, fault(package, policy)?))).collect()
}

/// What is wrong with a package's licence, if anything.
fn fault(package: &Licensed, policy: &Policy) -> Option<String> {
    let Some(licence) = &package.licence else {
        return Some("states no licence".to_owned());
    };
    // Lax, as older packages write `MIT/Apache-2.0`.
    let expression = match Expression::parse_mode(licence, ParseMode::LAX) {
        Ok(expression) => expression,
        Err(cause) => return Some(format!("`{licence}` is not an SPDX expression: {}", cause.reason)),
    };
    let own = policy.exceptions.iter().filter(|(name, _)| *name == package.name).map(|(_, licensee)| licensee);
    let accepted: Vec<&Licensee> = policy.allowed.iter().chain(own).collect();
    let allowed = expression.evaluate(|requirement| accepted.iter().any(|licensee| licensee.satisfies(requirement)));
    (!allowed).then(|| format!("`{licence}` is not allowed"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const POLICY: &str = r#"
        [licenses]
        allow = ["MIT", "Apache-2.0", "Apache-2.0 WITH LLVM-exception"]
        exceptions = [{ name = "tables", allow = ["Unicode-3.0"] }]
    "#;

    fn verdict(name: &str, licence: Option<&str>) -> Vec<String> {
        let package = Licensed { name: name.to_owned(), version: "1.0.0".to_owned(), licence: licence.map(str::to_owned) };
        faults(&[package], &policy(POLICY).unwrap())
    }

    #[test]
    fn one_allowed_choice_is_enough_and_every_part_is_needed() {
        for licence in ["MIT", "MIT OR GPL-3.0-only", "MIT/Apache-2.0", "(MIT OR Zlib) AND Apache-2.0", "Apache-2.0 WITH LLVM-exception"] {
            assert_eq!(verdict("any", Some(licence)), Vec::<String>::new(), "{licence}");
        }
        for licence in ["GPL-3.0-only", "MIT AND GPL-3.0-only", "MPL-2.0", "MIT WITH LLVM-exception", "nonsense", ""] {
            assert_eq!(verdict("any", Some(licence)).len(), 1, "{licence}");
        }
        assert_eq!(verdict("any", None), ["any 1.0.0: states no licence"]);
    }

    #[test]
    fn an_exception_is_for_one_package() {
        assert!(verdict("tables", Some("MIT AND Unicode-3.0")).is_empty());
        assert_eq!(verdict("other", Some("Unicode-3.0")), ["other 1.0.0: `Unicode-3.0` is not allowed"]);
    }

    #[test]
    fn a_torn_policy_is_refused() {
        for text in [
            "",
            "[licenses]",
            "[licenses]\nallow = 1",
            "[licenses]\nallow = [\"MITT\"]",
            "[licenses",
            "[licenses]\nallow = []\nexceptions = [{}]",
        ] {
            assert!(policy(text).is_err(), "{text}");
        }
    }

    #[test]
    fn the_policy_of_the_repository_is_well_formed() {
        let text = fs::read_to_string(Place::find().unwrap().at("deny.toml")).unwrap();
        assert!(!policy(&text).unwrap().allowed.is_empty());
    }
}
