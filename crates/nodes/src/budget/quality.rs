//! What a budget decides of a picture.

use pelage_graph::{FaultKind, Param, ParamSpec};
use pelage_render::{Detail, LightingMode, Options};

use crate::{LightingAt, ShellDetail};

/// What a `RenderImage` is told of how to draw, before its own parameters; of what is `None` it decides itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quality {
    /// At which level of detail.
    pub detail: Option<ShellDetail>,
    /// Whether fins are drawn.
    pub fins: Option<bool>,
    /// Where lighting is evaluated.
    pub lighting: Option<LightingAt>,
    /// Whether lighting at pixels uses the direction map.
    pub direction_map: Option<bool>,
    /// Layers that each drawn shell shows.
    pub march: Option<u32>,
    /// Samples for each layer.
    pub march_steps: Option<u32>,
    /// How strongly hairs shade each other.
    pub hair_shadow: Option<f64>,
    /// How much finer a slanted footprint is filtered.
    pub anisotropy: Option<u32>,
    /// The row of the table that says so, if it comes of one.
    pub row: Option<TableRow>,
}

/// What a table says of how to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableRow {
    /// Its line in the file, from 1.
    pub line: u64,
    /// How far back the camera stood.
    pub margin: f32,
    /// What it cost: milliseconds or fragments, as the budget looks at.
    pub cost: f64,
    /// How far it erred, mean FLIP.
    pub error: f64,
    /// How many shells were drawn, if the table says so.
    pub shells: Option<u32>,
}

/// A picture that is told how to draw by figures that are not of its coat.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the budget's table, line {line}, is of {measured} shells at this level of detail, and this coat has {drawn} there: measure a table of this coat with `pelage measure`"
)]
pub struct OtherCoatError {
    /// The row's line in the file, from 1.
    pub line: u64,
    /// Shells that were drawn when it was measured.
    pub measured: u32,
    /// Shells that are drawn now.
    pub drawn: u32,
}

/// Takes one of a `RenderImage`'s parameters from a text.
pub(super) type Take = fn(&mut Quality, &ParamSpec, &str) -> Result<(), Box<FaultKind>>;

/// The parameters that a budget may decide.
const DECIDED: &[(&str, Take)] = &[
    ("detail", |quality, param, text| set(&mut quality.detail, param, text)),
    ("fins", |quality, param, text| set(&mut quality.fins, param, text)),
    ("lighting", |quality, param, text| set(&mut quality.lighting, param, text)),
    ("direction_map", |quality, param, text| set(&mut quality.direction_map, param, text)),
    ("march", |quality, param, text| set(&mut quality.march, param, text)),
    ("march_steps", |quality, param, text| set(&mut quality.march_steps, param, text)),
    ("hair_shadow", |quality, param, text| set(&mut quality.hair_shadow, param, text)),
    ("anisotropy", |quality, param, text| set(&mut quality.anisotropy, param, text)),
];

fn set<T: Param>(field: &mut Option<T>, param: &ParamSpec, text: &str) -> Result<(), Box<FaultKind>> {
    *field = Some(param.read(text)?);
    Ok(())
}

impl Quality {
    /// Their names.
    pub(crate) fn decided() -> impl Iterator<Item = &'static str> {
        DECIDED.iter().map(|(name, _)| *name)
    }

    /// Whether a budget may decide an input of a `RenderImage`, which then does not count.
    pub fn decides(input: &str) -> bool {
        Self::decided().any(|name| name == input)
    }

    /// What takes the value of an input from a text, if a budget may decide it.
    pub(super) fn taker(input: &str) -> Option<Take> {
        DECIDED.iter().find(|(name, _)| *name == input).map(|(_, take)| *take)
    }

    /// That a picture of so many shells is of the coat that the table was measured of, as far as their number tells: a level of detail has as many from wherever it is seen.
    pub(crate) fn check(&self, drawn: u32) -> Result<(), OtherCoatError> {
        let measured = self.row.and_then(|row| Some((row.line, row.shells?)));
        match (measured, &self.detail) {
            (Some((line, measured)), Some(ShellDetail::Level { .. })) if measured != drawn => Err(OtherCoatError { line, measured, drawn }),
            _ => Ok(()),
        }
    }

    /// Puts what it decides in the place of what the options say.
    pub(crate) fn apply(&self, options: &mut Options) {
        let put = |option: &mut u32, value: Option<u32>| *option = value.unwrap_or(*option);
        put(&mut options.march.layers, self.march);
        put(&mut options.march.steps, self.march_steps);
        options.fins = self.fins.unwrap_or(options.fins);
        options.direction_map = self.direction_map.unwrap_or(options.direction_map);
        if let Some(detail) = &self.detail {
            options.detail = Detail::from(detail);
        }
        if let Some(lighting) = &self.lighting {
            options.lighting = LightingMode::from(lighting);
        }
        if let Some(hair_shadow) = self.hair_shadow {
            options.hair_shadow = hair_shadow as f32;
        }
        if let Some(anisotropy) = self.anisotropy {
            options.anisotropy = anisotropy as u16;
        }
    }
}
