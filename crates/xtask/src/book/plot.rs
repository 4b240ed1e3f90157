//! The plot of frame time over distance, from the figures that the frame benchmark wrote.

use std::fs;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::*;

use crate::failure::{Failure, Result};
use crate::place::Place;

/// Written by `cargo bench -p pelage-tests --bench spine -- far --write book/src/measured/distance.csv`.
const MEASURED: &str = "book/src/measured/distance.csv";
const PLOT: &str = "book/src/pictures/distance.svg";
const SIZE: (u32, u32) = (760, 400);

/// Curves by the least pixels between two shells, and what they are called.
const CURVES: [(&str, &str, RGBColor); 4] = [
    ("floor", "all shells, the same draw without lighting", RGBColor(190, 190, 190)),
    ("all", "all shells", RGBColor(90, 90, 90)),
    ("0.25", "0.25 pixels between shells (default)", RGBColor(31, 119, 180)),
    ("1", "1 pixel between shells", RGBColor(214, 96, 20)),
];

/// A frame that was measured.
#[derive(Debug, Clone, PartialEq)]
struct Frame {
    model: String,
    times: f64,
    pixels: String,
    shells: u32,
    /// Its time over that of all shells from once the distance.
    ratio: f64,
}

/// Draws the plot anew.
pub(crate) fn draw(place: &Place) -> Result<()> {
    let picture = place.at(PLOT);
    fs::write(&picture, svg(&read(place)?)?).map_err(|cause| Failure::caused(picture.display(), cause))
}

/// A line if the plot is not that of the figures.
pub(crate) fn faults(place: &Place) -> Result<Vec<String>> {
    let wanted = svg(&read(place)?)?;
    let same = fs::read_to_string(place.at(PLOT)).is_ok_and(|there| there.lines().eq(wanted.lines()));
    Ok(if same { Vec::new() } else { vec![format!("{PLOT} is not the plot of {MEASURED}: draw it with `cargo book plots`")] })
}

fn read(place: &Place) -> Result<Vec<Frame>> {
    let file = place.at(MEASURED);
    let text = fs::read_to_string(&file).map_err(|cause| Failure::caused(file.display(), cause))?;
    parse(&text).map_err(|cause| Failure::caused(MEASURED, cause))
}

/// `model,times,pixels,shells,level,of_nearest,…`, a line for each frame under a heading.
fn parse(text: &str) -> std::result::Result<Vec<Frame>, String> {
    let lines = text.lines().enumerate().skip(1).filter(|(_, line)| !line.trim().is_empty());
    let frames = lines.map(|(number, line)| {
        let words: Vec<&str> = line.split(',').collect();
        let frame = || {
            let [model, times, pixels, shells, _, ratio, ..] = words.as_slice() else { return None };
            let (times, ratio) = (times.parse().ok()?, ratio.parse().ok()?);
            Some(Frame { model: (*model).to_owned(), times, pixels: (*pixels).to_owned(), shells: shells.parse().ok()?, ratio })
        };
        frame().ok_or_else(|| format!("line {}: {line:?} is not model,times,pixels,shells,level,of_nearest", number + 1))
    });
    frames
        .collect::<std::result::Result<Vec<Frame>, String>>()
        .and_then(|frames| if frames.is_empty() { Err("no frame".into()) } else { Ok(frames) })
}

/// A panel for each model.
fn svg(frames: &[Frame]) -> Result<String> {
    let mut models: Vec<&str> = frames.iter().map(|frame| frame.model.as_str()).collect();
    models.dedup();
    let least = frames.iter().map(|frame| frame.ratio).fold(1.0, f64::min);
    let mut text = String::new();
    {
        let failed = |cause: String| Failure::caused(PLOT, cause);
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE).map_err(|cause| failed(cause.to_string()))?;
        for (panel, model) in root.split_evenly((1, models.len())).iter().zip(&models) {
            let own: Vec<&Frame> = frames.iter().filter(|frame| frame.model == *model).collect();
            draw_panel(panel, model, &own, least).map_err(|cause| failed(cause.to_string()))?;
        }
        root.present().map_err(|cause| failed(cause.to_string()))?;
    }
    Ok(text)
}

type Drawn<T> = std::result::Result<T, DrawingAreaErrorKind<<SVGBackend<'static> as DrawingBackend>::ErrorType>>;

/// Frame time over distance, both by powers of two, with the number of shells where it changes.
fn draw_panel(panel: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>, model: &str, frames: &[&Frame], least: f64) -> Drawn<()> {
    let furthest = frames.iter().map(|frame| frame.times).fold(1.0, f64::max);
    let mut chart = ChartBuilder::on(panel)
        .caption(model, ("sans-serif", 16))
        .margin(12)
        .x_label_area_size(36)
        .y_label_area_size(44)
        .build_cartesian_2d(Octaves(0.0, furthest.log2()), Octaves(least.log2().floor(), 0.2))?;
    chart
        .configure_mesh()
        .x_desc("times the distance")
        .y_desc("frame time, over the first")
        .label_style(("sans-serif", 13))
        .light_line_style(TRANSPARENT)
        .draw()?;
    for (pixels, label, colour) in CURVES {
        let curve: Vec<&&Frame> = frames.iter().filter(|frame| frame.pixels == pixels).collect();
        let points = || curve.iter().map(|frame| (frame.times.log2(), frame.ratio.log2()));
        chart
            .draw_series(LineSeries::new(points(), colour.stroke_width(2)))?
            .label(label)
            .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 18, y)], colour.stroke_width(2)));
        chart.draw_series(points().map(|point| Circle::new(point, 3, colour.filled())))?;
        // How many shells, where that changes.
        let mut before = curve.first().map_or(0, |frame| frame.shells);
        let fewer = curve.iter().filter(|frame| frame.shells != std::mem::replace(&mut before, frame.shells)).map(|frame| {
            let style = ("sans-serif", 12).into_font().color(&colour);
            Text::new(frame.shells.to_string(), (frame.times.log2() - 0.08, frame.ratio.log2() - 0.1), style)
        });
        chart.draw_series(fewer.collect::<Vec<_>>())?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerLeft)
        .background_style(WHITE.mix(0.8))
        .label_font(("sans-serif", 12))
        .draw()?;
    Ok(())
}

/// An axis of logarithms to base two, with a mark at each whole one, labelled with the number itself.
struct Octaves(f64, f64);

impl Ranged for Octaves {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        limit.0 + ((value - self.0) / (self.1 - self.0) * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        (self.0.ceil() as i32..=self.1.floor() as i32).map(f64::from).collect()
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.0..self.1
    }
}

impl ValueFormatter<f64> for Octaves {
    fn format_ext(&self, value: &f64) -> String {
        if *value < 0.0 { format!("1/{}", (-value).exp2().round()) } else { format!("{}", value.exp2().round()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "model,times,pixels,shells,level,of_nearest,least_ms\na ball,1.000,all,15,0.00,1.0,9\na ball,2.000,all,15,0.00,0.5,3\na ball,1.000,1,7,1.00,0.75,9\n\
        a ball,2.000,1,3,2.00,0.2,1\n";

    #[test]
    fn every_frame_is_read_and_drawn() {
        let frames = parse(TEXT).unwrap();
        assert_eq!(frames.len(), 4);
        assert_eq!(frames[3], Frame { model: "a ball".into(), times: 2.0, pixels: "1".into(), shells: 3, ratio: 0.2 });
        let drawn = svg(&frames).unwrap();
        assert_eq!(drawn.matches("<circle").count(), 4);
        assert!(drawn.contains("a ball") && drawn.contains("times the distance"));
        // Where the number of shells changes it is written: 3 is on no axis.
        assert_eq!(drawn.lines().filter(|line| line.trim() == "3").count(), 1);
    }

    #[test]
    fn a_line_that_is_no_frame_is_told_by_its_number() {
        assert!(parse("model\na,b,c").unwrap_err().contains("line 2"));
        assert!(parse("model,times\n").is_err());
    }

    #[test]
    fn an_axis_is_marked_at_powers_of_two() {
        let axis = Octaves(-2.5, 1.0);
        let marks: Vec<f64> = (0..4).map(|mark| f64::from(mark) - 2.0).collect();
        assert_eq!(marks.iter().map(|mark| axis.format_ext(mark)).collect::<Vec<_>>(), ["1/4", "1/2", "1", "2"]);
        assert_eq!(axis.range(), -2.5..1.0);
        assert_eq!([-2.5, 1.0].map(|value| axis.map(&value, (10, 110))), [10, 110]);
    }
}
