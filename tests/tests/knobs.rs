//! What the page of knobs says is what its figures say: every number of its advice is worked out anew from `book/src/measured`, and so is what its words claim.

use pelage_tests::{Error, Figures, Page, span};

/// A number with three places, as the tables of the page have it.
fn places(number: f64) -> String {
    format!("{number:.3}")
}

/// `0.013 to 0.024`, or one of them where they are alike.
fn range(of: [f64; 2]) -> String {
    to(of.map(places))
}

/// `12 to 15 %` of fractions.
fn percent(of: [f64; 2]) -> String {
    to(of.map(|part| format!("{:.0}", 100.0 * part))) + " %"
}

fn to([least, most]: [String; 2]) -> String {
    if least == most { least } else { format!("{least} to {most}") }
}

fn ensure(holds: bool, claim: impl Into<String>) -> Result<(), Error> {
    if holds { Ok(()) } else { Err(claim.into().into()) }
}

const DISTANCES: [&str; 5] = ["0.5 m", "1 m", "2 m", "4 m", "8 m"];

#[test]
fn shells_by_distance() -> Result<(), Error> {
    let (page, figures) = (Page::read("knobs")?, Figures::of("by-distance")?);
    let at = |column, distance, layers| figures.at(column, &[("distance", distance), ("shells.layers", layers)]);
    let lost = |column, from, to| -> Result<Vec<f64>, Error> {
        DISTANCES.iter().map(|d| Ok(at(column, *d, from)? - at(column, *d, to)?)).collect()
    };
    let times = |from, to| -> Result<Vec<f64>, Error> {
        DISTANCES.iter().map(|d| Ok(at("fragments", *d, to)? / at("fragments", *d, from)?)).collect()
    };
    let [least, most] = span(times("4", "32")?[2..].to_vec());
    page.says(&format!(
        "from 2 m on, 4 take a quarter of the fragments of 32 ({} times as many) and err by {} more, {} in the worst hundredth",
        to([least, most].map(|times| format!("{times:.1}"))),
        range(span(lost("flip_mean", "4", "32")?[2..].to_vec())),
        range(span(lost("flip_p99", "4", "32")?[2..].to_vec())),
    ))?;
    // What lies between costs more than 4 and is no better there, and from near it is.
    for distance in &DISTANCES[2..] {
        for layers in ["8", "16"] {
            ensure(
                at("flip_mean", distance, layers)? >= at("flip_mean", distance, "4")? - 0.001,
                format!("{layers} err less than 4 at {distance}"),
            )?;
            ensure(
                at("flip_p99", distance, layers)? >= at("flip_p99", distance, "4")? - 0.005,
                format!("{layers} err less than 4 at {distance} in the worst hundredth"),
            )?;
        }
    }
    page.says(&format!("at 0.5 m 16 gain {} on 4", places(at("flip_mean", "0.5 m", "4")? - at("flip_mean", "0.5 m", "16")?)))?;
    // 32 err least on the mean.
    for distance in DISTANCES {
        for layers in ["2", "4", "8", "16", "64"] {
            ensure(at("flip_mean", distance, "32")? < at("flip_mean", distance, layers)?, format!("{layers} err least at {distance}"))?;
        }
    }
    page.says(&format!(
        "half of them lose {} of the mean, {} of the worst hundredth and {:.0} % of the light, for {:.2} of the fragments",
        places(at("flip_mean", "2 m", "16")? - at("flip_mean", "2 m", "32")?),
        places(at("flip_p99", "2 m", "16")? - at("flip_p99", "2 m", "32")?),
        100.0 * (at("light", "2 m", "32")? - at("light", "2 m", "16")?),
        at("fragments", "2 m", "16")? / at("fragments", "2 m", "32")?,
    ))?;
    page.says(&format!(
        "Twice as many gain {} of the worst hundredth, lose {} of the mean as they are {:.0} % too bright, and take {:.1} times the fragments",
        places(at("flip_p99", "2 m", "32")? - at("flip_p99", "2 m", "64")?),
        places(at("flip_mean", "2 m", "64")? - at("flip_mean", "2 m", "32")?),
        100.0 * (at("light", "2 m", "64")? - 1.0),
        at("fragments", "2 m", "64")? / at("fragments", "2 m", "32")?,
    ))?;
    // Two are too bright everywhere, four to sixteen too dark.
    for distance in DISTANCES {
        ensure(at("light", distance, "2")? > 1.1, format!("two shells at {distance} are not too bright"))?;
        for layers in ["4", "8", "16"] {
            ensure(at("light", distance, layers)? < 0.98, format!("{layers} shells at {distance} are not too dark"))?;
        }
    }
    Ok(())
}

#[test]
fn texels_spacing_and_filter() -> Result<(), Error> {
    let page = Page::read("knobs")?;
    let resolution = Figures::of("resolution")?;
    for layers in ["16", "32"] {
        let at = |texels| resolution.at("flip_mean", &[("shells.resolution", texels), ("shells.layers", layers)]);
        ensure(at("128")? - at("512")? < 0.005, "more than 128² texels gain 0.005")?;
    }
    page.says("four times the bytes for less than 0.005 beyond")?;
    let spacing = Figures::of("spacing")?;
    let at = |column, spaced, layers| spacing.at(column, &[("shells.spacing", spaced), ("shells.layers", layers)]);
    let (mut fewer, mut gains) = (Vec::new(), Vec::new());
    for layers in ["8", "16", "32"] {
        fewer.push(1.0 - at("fragments", "Exponential(rate: 1.0)", layers)? / at("fragments", "Even", layers)?);
        gains.push(at("flip_mean", "Even", layers)? - at("flip_mean", "Exponential(rate: 1.0)", layers)?);
    }
    page.says(&format!("the first has {} fewer fragments and errs by {} less", percent(span(fewer)), range(span(gains))))?;
    let filter = Figures::of("filter")?;
    let at = |texels| filter.at("flip_mean", &[("shells.softness", texels)]);
    ensure((at("0.5")? - at("0.0")?).abs() < 0.0015, "a filter of half a texel errs otherwise than none")?;
    ensure(at("2.0")? - at("0.5")? > 0.003, "two texels lose no detail")?;
    let blur = Figures::of("step-blur")?;
    let at = |seen, levels| blur.at("flip_mean", &[("seen", seen), ("picture.step_blur", levels)]);
    page.says(&format!(
        "near, with few shells, 1.5 levels of it cost {}; from afar nothing",
        places(at("near", "1.5")? - at("near", "0.0")?)
    ))?;
    ensure((at("from afar", "4.0")? - at("from afar", "0.0")?).abs() < 5e-4, "from afar blur costs something")
}

#[test]
fn fins() -> Result<(), Error> {
    let page = Page::read("knobs")?;
    let rule = Figures::of("fin-rule")?;
    let faded = rule.at("flip_mean", &[("picture.fins_on", "Faded")])?;
    let whole =
        ["Silhouettes(threshold: 0.1)", "Silhouettes(threshold: 0.2)", "Silhouettes(threshold: 0.4)", "Silhouettes(threshold: 0.7)", "All"];
    let differences =
        whole.iter().map(|on| Ok((rule.at("flip_mean", &[("picture.fins_on", on)])? - faded).abs())).collect::<Result<Vec<_>, Error>>()?;
    page.says(&format!("Whole fins from a threshold of 0.1 on differ from them by no more than {}", places(span(differences)[1])))?;
    let slab = Figures::of("fin-density")?;
    let at = |depth| slab.at("outline_shift", &[("fin.slab_width", depth)]);
    page.says(&format!("the outline is {:.1} pixels short there, and right at 0.16", -at("0.12")?))?;
    ensure(at("0.16")?.abs() < 0.1, "the outline is not right at 0.16")?;
    let nine = Figures::of("slab")?;
    let mean = |column: &str, depth: &str| -> Result<f64, Error> {
        let all = nine.by(&["fin.slab_width"], column)?;
        let of = &all[depth];
        Ok(of.iter().sum::<f64>() / of.len() as f64)
    };
    page.says(&format!(
        "0.12 and 0.16 err alike ({} and {} of alpha)",
        places(mean("outline_rms", "0.12")?),
        places(mean("outline_rms", "0.16")?)
    ))?;
    page.says(&format!(
        "0.12 is {:.2} pixels short where 0.16 is {:.2} too far out",
        -mean("outline_shift", "0.12")?,
        mean("outline_shift", "0.16")?
    ))?;
    let texels = Figures::of("fin-texture")?;
    for tiles in ["1", "3"] {
        let from = ["(128, 16)", "(256, 32)", "(512, 64)", "(1024, 128)"];
        let rms = from
            .iter()
            .map(|size| texels.at("outline_rms", &[("fin.size", size), ("fin.tiles_across", tiles)]))
            .collect::<Result<Vec<_>, _>>()?;
        let [least, most] = span(rms);
        ensure(most - least < 0.0025, "a finer fin changes the outline by more than 0.002")?;
    }
    let quads = Figures::of("fin-segments")?;
    let at = |column, count| quads.at(column, &[("picture.fin_segments", count)]);
    page.says(&format!(
        "the outline of a coat that lies down is {:.2} pixels nearer, its error {} less",
        at("outline_shift", "4")? - at("outline_shift", "1")?,
        places(at("outline_rms", "1")? - at("outline_rms", "4")?)
    ))
}

#[test]
fn levels_of_detail() -> Result<(), Error> {
    let (page, figures) = (Page::read("knobs")?, Figures::of("levels")?);
    let at = |column, distance: &str, pixels: &str| {
        figures.at(column, &[("distance", distance), ("picture.detail", &format!("Spacing(pixels: {pixels})"))])
    };
    let loses = |distance, pixels| -> Result<f64, Error> { Ok(at("flip_mean", distance, pixels)? - at("flip_mean", distance, "0.0")?) };
    for distance in DISTANCES {
        ensure(loses(distance, "0.5")? < 0.001, format!("0.5 loses at {distance}"))?;
    }
    for distance in &DISTANCES[..4] {
        ensure(loses(distance, "1.0")? < 0.001, format!("1.0 loses at {distance}"))?;
    }
    let share = |distance, pixels| -> Result<f64, Error> { Ok(at("fragments", distance, pixels)? / at("fragments", distance, "0.0")?) };
    page.says(&format!(
        "up to 0.5 no further from the truth than all shells; at 4 m 0.25 takes {:.1} of the fragments, 0.5 {:.1} and 1.0 {:.1}, and at 8 m 1.0 loses {}",
        share("4 m", "0.25")?,
        share("4 m", "0.5")?,
        share("4 m", "1.0")?,
        places(loses("8 m", "1.0")?)
    ))?;
    page.says(&format!("at 2.0 and 8 m one shell is left, which is the {}", places(at("flip_mean", "8 m", "2.0")?)))?;
    ensure(at("shells", "8 m", "2.0")? < 1.5, "there is more than one shell")
}

#[test]
fn light() -> Result<(), Error> {
    let page = Page::read("knobs")?;
    let bunny = Figures::of("bunny-picture")?;
    let at = |column, lighting| {
        bunny.at(
            column,
            &[("picture.lighting", lighting), ("picture.samples", "1"), ("picture.depth", "Written"), ("picture.fins_on", "Faded")],
        )
    };
    let (mut gains, mut longer) = (Vec::new(), Vec::new());
    for lighting in ["Table(size: 64)", "Pixels"] {
        gains.push(at("flip_mean", "Vertices")? - at("flip_mean", lighting)?);
        longer.push(at("ms_min", lighting)? / at("ms_min", "Vertices")? - 1.0);
    }
    page.says(&format!("without a map light by pixel gains {} for {} more time", range(span(gains)), percent(span(longer))))?;
    let table = Figures::of("table")?;
    let at = |lighting| table.at("flip_mean", &[("picture.lighting", lighting)]);
    page.says(&format!("the table is the formula to {}", places(at("Table(size: 64)")?)))?;
    let curls = Figures::of("lighting")?;
    let at = |column, lighting, map| curls.at(column, &[("picture.lighting", lighting), ("picture.direction_map", map)]);
    let longer = ["Table(size: 64)", "Pixels"]
        .map(|lighting| Ok::<f64, Error>(at("ms_min", lighting, "true")? / at("ms_min", "Vertices", "false")? - 1.0));
    page.says(&format!("with the map, {} more time than at vertices", percent(span(longer.into_iter().collect::<Result<Vec<_>, _>>()?))))?;
    let map = Figures::of("claim-direction")?.by(&["hair"], "flip_mean")?;
    for (hair, flip) in map {
        let gains: Vec<f64> = flip.chunks_exact(2).map(|pair| pair[0] - pair[1]).collect();
        let [least, most] = span(gains);
        ensure(
            if hair == "curly" { least > 0.03 } else { most < 0.005 },
            format!("the direction map gains {least} to {most} of {hair} hair"),
        )?;
    }
    Ok(())
}

#[test]
fn shadows() -> Result<(), Error> {
    let page = Page::read("knobs")?;
    let shadows = Figures::of("shadows")?;
    let at = |column, map, hair| shadows.at(column, &[("picture.shadows", map), ("picture.hair_shadow", hair)]);
    let excess = |map| -> Result<f64, Error> { Ok(at("light", map, "0.0")? - 1.0) };
    page.says(&format!(
        "without, {:.1} times the light of rays; the map takes {:.2} of the excess and {:.2} of the error, from hair to hair another {:.2}",
        at("light", "false", "0.0")?,
        1.0 - excess("true")? / excess("false")?,
        at("flip_mean", "false", "0.0")? - at("flip_mean", "true", "0.0")?,
        at("flip_mean", "true", "0.0")? - at("flip_mean", "true", "1.0")?,
    ))?;
    let size = Figures::of("shadow-size")?;
    let at = |texels| size.at("flip_mean", &[("picture.shadow_size", texels)]);
    page.says(&format!(
        "512 errs by {} more; finer than 1024 by {} less",
        places(at("512")? - at("1024")?),
        places(at("1024")? - at("4096")?)
    ))
}

#[test]
fn economies() -> Result<(), Error> {
    let page = Page::read("knobs")?;
    let economy = Figures::of("economy")?;
    let hairs = ["straight", "of one colour", "wavy", "curly"];
    let at = |column, hair, shells: &str| economy.at(column, &[("hair", hair), ("coat.shells", &format!("\"{shells}.shells\""))]);
    let blocks = hairs.map(|hair| at("flip_mean", hair, "blocks")).into_iter().collect::<Result<Vec<_>, _>>()?;
    let longer = hairs
        .map(|hair| Ok(at("ms_min", hair, "blocks")? / at("ms_min", hair, "shells")?))
        .into_iter()
        .collect::<Result<Vec<f64>, Error>>()?;
    let [least, most] = span(longer);
    page.says(&format!(
        "{} for a quarter of the images' bytes, in {least:.1} to {most:.1} times the time on an adapter in software",
        range(span(blocks))
    ))?;
    page.says(&format!(
        "errs by {} there, and by {} where hair is darker at the root",
        places(at("flip_mean", "of one colour", "one")?),
        places(at("flip_mean", "straight", "one")?)
    ))?;
    let march = Figures::of("marching")?;
    let at = |column, layers| march.at(column, &[("picture.march_steps", "1"), ("picture.march", layers)]);
    page.says(&format!(
        "{:.2} and {:.2} of the fragments, and nearer to the truth by {} and {}; on an adapter in software {:.1} and {:.1} times the time",
        at("fragments", "2")? / at("fragments", "1")?,
        at("fragments", "4")? / at("fragments", "1")?,
        places(at("flip_mean", "1")? - at("flip_mean", "2")?),
        places(at("flip_mean", "1")? - at("flip_mean", "4")?),
        at("ms_min", "2")? / at("ms_min", "1")?,
        at("ms_min", "4")? / at("ms_min", "1")?,
    ))?;
    let mixtures = Figures::of("mixtures")?;
    let at = |column, count| mixtures.at(column, &[("mixtures", count)]);
    page.says(&format!(
        "2 err by {} more for {:.1} of the bytes, 8 by {} less for {:.1} times as many",
        places(at("flip_mean", "2")? - at("flip_mean", "4")?),
        at("texture_bytes", "2")? / at("texture_bytes", "4")?,
        places(at("flip_mean", "4")? - at("flip_mean", "8")?),
        at("texture_bytes", "8")? / at("texture_bytes", "4")?,
    ))
}

#[test]
fn samples_depth_and_anisotropy() -> Result<(), Error> {
    let page = Page::read("knobs")?;
    let samples = Figures::of("samples")?;
    let at = |column, count, depth| samples.at(column, &[("picture.samples", count), ("picture.depth", depth)]);
    ensure((at("flip_mean", "1", "Written")? - at("flip_mean", "4", "Written")?).abs() < 0.001, "one sample errs otherwise than four")?;
    page.says(&format!("1 errs no more, in {:.1} of the time", at("ms_min", "1", "Written")? / at("ms_min", "4", "Written")?))?;
    let bunny = Figures::of("bunny-picture")?;
    let of_bunny = |depth| {
        let own = [("picture.lighting", "Vertices"), ("picture.samples", "1"), ("picture.fins_on", "Faded"), ("picture.depth", depth)];
        bunny.at("flip_mean", &own)
    };
    page.says(&format!(
        "`Tested` takes {:.0} % more fragments, and errs by {} less on this coat, by {} more on that of `graphs/bunny.ron`; `Coverage` of 4 samples errs as `Written`, for {:.1} of the fragments, and is grainy",
        100.0 * (at("fragments", "4", "Tested")? / at("fragments", "4", "Written")? - 1.0),
        places(at("flip_mean", "4", "Written")? - at("flip_mean", "4", "Tested")?),
        places(of_bunny("Tested")? - of_bunny("Written")?),
        at("fragments", "4", "Coverage")? / at("fragments", "4", "Written")?,
    ))?;
    ensure((at("flip_mean", "4", "Written")? - at("flip_mean", "4", "Coverage")?).abs() < 0.001, "coverage errs otherwise")?;
    let anisotropy = Figures::of("anisotropy")?;
    let at = |most| anisotropy.at("flip_mean", &[("picture.anisotropy", most)]);
    page.says(&format!("errs by {} more", places(at("2")? - at("1")?)))
}

#[test]
fn hair_patches_and_faces() -> Result<(), Error> {
    let page = Page::read("knobs")?;
    let steps = Figures::of("hair-steps")?;
    let at = |count| steps.at("outline_rms", &[("hair.steps", count)]);
    page.says(&format!(
        "from 24 to 48 the outline's error falls by {}, beyond by {}",
        places(at("24")? - at("48")?),
        places(at("48")? - at("96")?)
    ))?;
    let mut flips = Vec::new();
    for (sweep, input) in [("patches", "patches.alignment"), ("patch-limits", "patches.max_stretch")] {
        flips.extend(Figures::of(sweep)?.by(&[input], "flip_mean")?.into_values().flatten());
    }
    let [least, most] = span(flips);
    page.says(&format!("all within {} of each other, without a trend", places(most - least)))?;
    let simple = Figures::of("simplify")?;
    let at = |column, share| simple.at(column, &[("simple.share", share)]);
    page.says(&format!(
        "half of the bunny's 3,674 faces move the outline by {:.1} pixels, a fifth by {:.1}, and take {:.1} and {:.1} of the time",
        -at("outline_shift", "0.5")?,
        -at("outline_shift", "0.2")?,
        at("ms_ratio", "0.5")?,
        at("ms_ratio", "0.2")?,
    ))?;
    let [least, most] = span(Figures::of("tolerance")?.by(&[], "flip_mean")?.into_values().flatten());
    page.says(&format!("from 1.0 to 0.01 nothing changes by more than {:.4}", most - least))
}

#[test]
fn chance_and_noise() -> Result<(), Error> {
    let page = Page::read("knobs")?;
    let spread = |sweep: &str, layers: &str| -> Result<f64, Error> {
        let [least, most] = span(Figures::of(sweep)?.by(&["shells.layers"], "flip_mean")?.remove(layers).unwrap_or_default());
        Ok(most - least)
    };
    page.says(&format!("differs by up to {} from seed to seed", places(spread("seeds", "16")?.max(spread("seeds", "32")?))))?;
    let noise = span(["8", "16", "32"].map(|layers| spread("noise", layers)).into_iter().collect::<Result<Vec<_>, _>>()?)[1];
    page.says(&format!("with the truth's own noise by {noise:.4}"))?;
    // And so does what is argued from: the gain from one number of shells to the next.
    let of = Figures::of("noise")?.by(&["rays"], "flip_mean")?;
    let [least, most] = span(of.into_values().map(|flip| flip[1] - flip[2]));
    page.says(&format!("what 32 layers gain on 16 by {:.4}", most - least))
}
