//! What each option costs, beside the default and the same draw.

use std::sync::Arc;

use pelage_coat::Coat;
use pelage_lighting::TableLayout;
use pelage_render::{FinRule, LightingMode, March, Options, ShadowOptions, ShellDepth};
use pelage_tests::{Contender, Fur};

use super::scenes::{Scenes, Textures};
use super::{Bench, print};

/// An option, the textures that it wants, and whether the shadow map is drawn anew each frame.
struct Case<'a> {
    name: &'a str,
    options: Options,
    textures: Textures<'a>,
    redraw: bool,
}

impl Bench<'_> {
    /// Each option with one sample a pixel, in turn with the default; coverage and anisotropy also with four.
    pub fn options(&self, coat: &Arc<Coat>, scenes: &mut Scenes<'_>, name: &str) {
        let defaults = self.view.options;
        let cases = cases(defaults);
        println!("\n{name}, options, 1 sample a pixel");
        self.cases(coat, scenes, &cases, 1, true);
        let coverage = ShellDepth::Coverage { threshold: 0.02 };
        let fine = |name, options| Case { name, options, textures: Textures::default(), redraw: false };
        let cases = [
            fine("alpha to coverage", Options { shell_depth: coverage, ..defaults }),
            fine("anisotropy 4", Options { anisotropy: 4, ..defaults }),
        ];
        println!("\n{name}, options, 4 samples a pixel");
        self.cases(coat, scenes, &cases, 4, false);
    }

    fn cases(&self, coat: &Arc<Coat>, scenes: &mut Scenes<'_>, cases: &[Case<'_>], samples: u32, hidden: bool) {
        let stage = self.stage(samples);
        let default = Fur::new(self.headless, stage, coat, &self.view).expect("a whole coat");
        let floor = self.floor(stage, coat, &self.view, &default);
        let mut two_passes = Fur::new(self.headless, stage, coat, &self.view).expect("a whole coat");
        let furs: Vec<(&Case<'_>, Fur)> = cases
            .iter()
            .map(|case| {
                let coat = scenes.coat(case.textures).expect("a coat");
                (case, Fur::with(self.headless, stage, &coat, &self.view, case.options).expect("a whole coat"))
            })
            .collect();
        let ours = |fur, name, redraw| Contender::ours(self.headless, stage, fur, name, redraw).expect("the device answers");
        let mut contenders = vec![ours(&default, "default", false)];
        let same_draw = Contender::plain(self.headless, stage, "floor: same draw", None, |pass| floor.draw(pass));
        contenders.push(same_draw.expect("the device answers"));
        contenders.extend(furs.iter().map(|(case, fur)| ours(fur, case.name, case.redraw)));
        if hidden {
            contenders.push(Contender::hidden(
                self.headless,
                stage,
                &mut two_passes,
                "hidden faces left out, fins and shells in a second pass",
            ));
        }
        print(&self.race(stage, contenders, [1, 0]), ["of same draw", "of default"]);
    }
}

fn cases(defaults: Options) -> Vec<Case<'static>> {
    let plain = |name, options| Case { name, options, textures: Textures::default(), redraw: false };
    let other = |name, textures| Case { name, options: defaults, textures, redraw: false };
    let pixels = Options { lighting: LightingMode::Formula, ..defaults };
    let shadows = Options { shadows: Some(ShadowOptions::default()), ..defaults };
    let march = |layers, steps| Options { march: March { layers, steps }, ..defaults };
    let directions = Textures { set: &[("shells.directions", "true")], ..Textures::default() };
    vec![
        plain("lit at pixels, formula", pixels),
        plain("lit at pixels, 64² table", Options { lighting: LightingMode::Table(TableLayout::default()), ..defaults }),
        Case { options: pixels, ..other("lit at pixels, direction map", directions) },
        plain("shadow from hair to hair", Options { hair_shadow: 1.0, ..defaults }),
        Case { redraw: true, ..plain("shadow map, drawn anew each frame", shadows) },
        plain("shadow map, still", shadows),
        plain("march 4 layers", march(4, 1)),
        plain("march 4 layers by 4 steps", march(4, 4)),
        plain("alpha to coverage", Options { shell_depth: ShellDepth::Coverage { threshold: 0.02 }, ..defaults }),
        plain("depth only tested", Options { shell_depth: ShellDepth::Tested, ..defaults }),
        other("images in blocks (BC3)", Textures { through: &["CompressShells"], ..Textures::default() }),
        other(
            "one layer, straight hair",
            Textures { set: &[("hair.style", "Straight")], through: &["OneLayer"], with: &[("economy0.tolerance", "1.0")] },
        ),
        other(
            "20 images shared by 60 shells",
            Textures { set: &[("shells.layers", "20")], through: &["ShareImages"], with: &[("economy0.count", "60")] },
        ),
        plain("fins of 4 quads", Options { fin_segments: 4, ..defaults }),
        plain("fins on silhouettes (NVIDIA's)", Options { fin_rule: FinRule::Silhouette { threshold: 0.2 }, ..defaults }),
        plain("without fins", Options { fins: false, ..defaults }),
        plain("all faces submitted", Options { culling: false, ..defaults }),
        plain("without step blur", Options { step_blur: 0.0, ..defaults }),
        plain("anisotropy 4", Options { anisotropy: 4, ..defaults }),
    ]
}
