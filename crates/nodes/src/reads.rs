//! What of a coat a picture reads, by the switches of [`RenderImage`](crate::RenderImage).

use pelage_graph::{Param, Params, Part};

use crate::parts::{DIRECTIONS, FINS, LAYERS, LEVELS, LOOKS, SKIN};
use crate::{LightingAt, Quality, ShellDetail};

/// A parameter, where it is the parameter that decides and not a value that is linked in its place, or a budget.
fn known<P: Param>(params: &Params<'_>, name: &str) -> Option<P> {
    let by_budget = params.is_linked("budget") && Quality::decided().any(|decided| decided == name);
    if by_budget { None } else { params.get(name) }
}

/// What is drawn, as far as the parameters say; what is linked may be anything, so it is taken to be on.
struct Drawn {
    surface: bool,
    shells: bool,
    fins: bool,
    /// Whether there is fur that casts shadows, drawn or not.
    casts: bool,
}

impl Drawn {
    fn of(params: &Params<'_>) -> Self {
        let on = |name| known::<bool>(params, name).unwrap_or(true);
        // Without length there is no fur.
        let furry = known::<f64>(params, "length_scale").is_none_or(|scale| scale > 0.0);
        // The first is the skin.
        let several = known::<u32>(params, "shell_count").is_none_or(|count| count > 1);
        Self { surface: on("surface"), shells: furry && several && on("shells"), fins: furry && on("fins"), casts: furry && on("shadows") }
    }
}

/// The parts of the coat that the picture depends on.
pub(crate) fn drawn_parts(params: &Params<'_>) -> Vec<Part> {
    let drawn = Drawn::of(params);
    let parts = [
        (SKIN, drawn.surface),
        (LAYERS, drawn.shells || drawn.casts),
        (LEVELS, reads_levels(params, &drawn)),
        (DIRECTIONS, drawn.shells && reads_directions(params)),
        (FINS, drawn.fins),
        (LOOKS, true),
    ];
    parts.into_iter().filter(|(_, read)| *read).map(|(part, _)| part).collect()
}

/// Whether it makes a difference that there are coarser levels of detail. The skin has the hair on it that a coarser level lays there, and fins go with the last shell.
fn reads_levels(params: &Params<'_>, drawn: &Drawn) -> bool {
    // Where shells show several layers, levels round their number up to a power of two; of the shells that cast, they choose those that stay from level to level.
    let several = known::<u32>(params, "march").is_none_or(|layers| !layers.is_power_of_two());
    drawn.casts || (drawn.surface || drawn.shells || drawn.fins) && (several || leaves_the_finest(params))
}

/// Whether another level than the finest may be drawn.
fn leaves_the_finest(params: &Params<'_>) -> bool {
    let whole = known::<u32>(params, "march_steps").is_some_and(|steps| steps > 1);
    match known::<ShellDetail>(params, "detail") {
        // What lies between layers is marched through in whole levels, by the finest unless another is asked for.
        Some(ShellDetail::Spacing { pixels }) => pixels > 0.0 && !whole,
        Some(ShellDetail::Level { level }) => {
            if whole {
                level >= 0.5
            } else {
                level > 0.0
            }
        }
        None => true,
    }
}

/// Whether the hair's direction is looked up at every pixel.
fn reads_directions(params: &Params<'_>) -> bool {
    let by_pixel = !matches!(known::<LightingAt>(params, "lighting"), Some(LightingAt::Patches | LightingAt::Vertices));
    by_pixel && known::<bool>(params, "direction_map").unwrap_or(true)
}
