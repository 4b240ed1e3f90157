//! The plot of a sweep: errors over what was varied, and over what it cost.

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use crate::{AccuracyError, Group, Sweep, pareto_front};

/// One diagram of a plot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Panel {
    /// An error over the values of an input, in the order in which they come: a curve for each combination of the other inputs' values.
    Knob {
        /// The input across, one of those that vary.
        input: String,
        /// The column upwards.
        error: String,
    },
    /// An error over a cost: each setting a point, with a line along those that no other of its group beats.
    Cost {
        /// The column across.
        cost: String,
        /// The column upwards.
        error: String,
    },
}

/// Pixels of a panel.
const PANEL: (u32, u32) = (460, 360);
/// Panels beside each other at most.
const ACROSS: usize = 2;
/// The longest label of a value, in letters.
const LONGEST: usize = 22;
const POINT: RGBColor = RGBColor(130, 130, 130);
/// A colour for each curve, then over again.
const CURVES: [RGBColor; 8] = [
    RGBColor(31, 119, 180),
    RGBColor(214, 96, 20),
    RGBColor(44, 150, 60),
    RGBColor(190, 40, 50),
    RGBColor(128, 90, 180),
    RGBColor(120, 80, 60),
    RGBColor(220, 110, 180),
    RGBColor(20, 160, 170),
];

type Drawn<T> = Result<T, DrawingAreaErrorKind<<SVGBackend<'static> as DrawingBackend>::ErrorType>>;
type Area<'a, 'b> = DrawingArea<SVGBackend<'b>, Shift>;

/// A curve, or the points of a group.
struct Series {
    name: String,
    points: Vec<(f64, f64)>,
}

/// What the axes are called, how far they go, and which words stand along the one across, if no numbers do.
struct Axes {
    names: (String, String),
    across: std::ops::Range<f64>,
    upwards: f64,
    words: Vec<String>,
}

impl Sweep {
    /// The sweep as SVG: its diagrams two by two under the title.
    ///
    /// # Errors
    ///
    /// Those of [`check`](Self::check); [`NoSuchColumn`](AccuracyError::NoSuchColumn), and [`NoValues`](AccuracyError::NoValues) for a plot without a panel, or a panel without a point.
    pub fn to_svg(&self, title: &str, panels: &[Panel]) -> Result<String, AccuracyError> {
        if panels.is_empty() {
            return Err(AccuracyError::NoValues);
        }
        let failed = |error: DrawingAreaErrorKind<_>| AccuracyError::Plot(error.to_string());
        let across = panels.len().min(ACROSS);
        let down = panels.len().div_ceil(across);
        let mut text = String::new();
        {
            let size = (PANEL.0 * across as u32, PANEL.1 * down as u32 + 30);
            let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
            root.fill(&WHITE).map_err(failed)?;
            let body = root.titled(title, ("sans-serif", 18)).map_err(failed)?;
            for (panel, area) in panels.iter().zip(body.split_evenly((down, across))) {
                match panel {
                    Panel::Knob { input, error } => self.draw_knob(input, error, &area)?,
                    Panel::Cost { cost, error } => self.draw_cost(cost, error, &area)?,
                }
            }
            root.present().map_err(failed)?;
        }
        Ok(text)
    }

    fn draw_knob(&self, input: &str, error: &str, area: &Area<'_, '_>) -> Result<(), AccuracyError> {
        self.check()?;
        let (knob, column) = (self.varied_index(input)?, self.column(error)?);
        let mut words: Vec<&str> = Vec::new();
        for row in &self.rows {
            if !words.contains(&row.settings[knob].as_str()) {
                words.push(&row.settings[knob]);
            }
        }
        let others: Vec<String> = self.varied.iter().filter(|name| *name != input).cloned().collect();
        let place = |row: usize| words.iter().position(|word| *word == self.rows[row].settings[knob]).unwrap_or_default() as f64;
        let curve = |group: Group| Series {
            points: finite(group.rows.iter().map(|&row| (place(row), self.rows[row].values[column]))),
            name: group.name,
        };
        let curves: Vec<Series> = self.groups(&others)?.into_iter().map(curve).collect();
        let axes = Axes {
            names: (input.to_owned(), self.named(column)),
            across: -0.25..words.len() as f64 - 0.75,
            upwards: upwards(&curves)?,
            words: words.iter().map(|word| cut(word)).collect(),
        };
        draw_curves(area, &axes, &curves).map_err(|error| AccuracyError::Plot(error.to_string()))
    }

    fn draw_cost(&self, cost: &str, error: &str, area: &Area<'_, '_>) -> Result<(), AccuracyError> {
        let points = self.points(cost, error)?;
        let names = (self.named(self.column(cost)?), self.named(self.column(error)?));
        let groups = self.groups(&self.grouped_by)?;
        let own = |group: &Group| Series { name: group.name.clone(), points: finite(group.rows.iter().map(|&row| points[row])) };
        let series: Vec<Series> = groups.iter().map(own).collect();
        let furthest = series.iter().flat_map(|one| &one.points).map(|point| point.0).fold(0.0, f64::max);
        // Room for the labels to the right of the last point.
        let axes = Axes { names, across: 0.0..room(1.25 * furthest), upwards: upwards(&series)?, words: Vec::new() };
        let labels: Vec<((f64, f64), String)> = groups.iter().flat_map(|group| self.labels(group, &points)).collect();
        draw_fronts(area, &axes, &series, &labels).map_err(|error| AccuracyError::Plot(error.to_string()))
    }

    /// The values of each setting beside its point, where all settings are one group.
    fn labels(&self, group: &Group, points: &[(f64, f64)]) -> Vec<((f64, f64), String)> {
        // Points of many groups would hide each other's labels: their curves have names.
        if !self.grouped_by.is_empty() {
            return Vec::new();
        }
        let label = |&row: &usize| (points[row], cut(&self.rows[row].settings.join(", ")));
        group.rows.iter().map(label).filter(|(point, _)| point.0.is_finite() && point.1.is_finite()).collect()
    }

    fn named(&self, column: usize) -> String {
        format!("{}, {}", self.columns[column].name, self.columns[column].unit)
    }
}

fn finite(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    points.filter(|point| point.0.is_finite() && point.1.is_finite()).collect()
}

/// How far the axis upwards goes.
fn upwards(series: &[Series]) -> Result<f64, AccuracyError> {
    let highest = series.iter().flat_map(|one| &one.points).map(|point| point.1).reduce(f64::max);
    highest.map(|highest| room(1.1 * highest)).ok_or(AccuracyError::NoValues)
}

fn draw_curves(area: &Area<'_, '_>, axes: &Axes, curves: &[Series]) -> Drawn<()> {
    let mut chart = chart(area, axes)?;
    for (curve, colour) in curves.iter().zip(CURVES.iter().cycle().copied()) {
        let series = chart.draw_series(LineSeries::new(curve.points.iter().copied(), colour.stroke_width(2)))?;
        if curves.len() > 1 {
            series.label(cut(&curve.name)).legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 16, y)], colour.stroke_width(2)));
        }
        chart.draw_series(curve.points.iter().map(|&point| Circle::new(point, 3, colour.filled())))?;
    }
    legend(&mut chart, curves.len())
}

fn draw_fronts(area: &Area<'_, '_>, axes: &Axes, groups: &[Series], labels: &[((f64, f64), String)]) -> Drawn<()> {
    let mut chart = chart(area, axes)?;
    for (group, colour) in groups.iter().zip(CURVES.iter().cycle().copied()) {
        chart.draw_series(group.points.iter().map(|&point| Circle::new(point, 3, POINT.filled())))?;
        let front: Vec<(f64, f64)> = pareto_front(&group.points).into_iter().map(|index| group.points[index]).collect();
        let series = chart.draw_series(LineSeries::new(front.iter().copied(), colour.stroke_width(2)))?;
        if groups.len() > 1 {
            series.label(cut(&group.name)).legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 16, y)], colour.stroke_width(2)));
        }
        chart.draw_series(front.iter().map(|&point| Circle::new(point, 4, colour.filled())))?;
    }
    let text = |(point, label): &((f64, f64), String)| EmptyElement::at(*point) + Text::new(label.clone(), (6, -12), ("sans-serif", 11));
    chart.draw_series(labels.iter().map(text))?;
    legend(&mut chart, groups.len())
}

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The axes.
fn chart<'a, 'b>(area: &'a Area<'_, 'b>, axes: &Axes) -> Drawn<Chart<'a, 'b>> {
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(62)
        .build_cartesian_2d(axes.across.clone(), 0.0..axes.upwards)?;
    let number = |value: &f64| shortened(*value);
    let word = |value: &f64| {
        let near = value.round();
        if (value - near).abs() < 1e-6 && near >= 0.0 { axes.words.get(near as usize).cloned().unwrap_or_default() } else { String::new() }
    };
    let across: &dyn Fn(&f64) -> String = if axes.words.is_empty() { &number } else { &word };
    chart
        .configure_mesh()
        .x_desc(&axes.names.0)
        .y_desc(&axes.names.1)
        .x_labels(if axes.words.is_empty() { 5 } else { axes.words.len() + 1 })
        .x_label_formatter(across)
        .y_label_formatter(&number)
        .label_style(("sans-serif", 12))
        .light_line_style(TRANSPARENT)
        .draw()?;
    Ok(chart)
}

/// Which curve is which, where there are several.
fn legend<'a, 'b: 'a>(chart: &mut Chart<'a, 'b>, curves: usize) -> Drawn<()> {
    if curves < 2 {
        return Ok(());
    }
    let mut labels = chart.configure_series_labels();
    labels.position(SeriesLabelPosition::UpperRight).background_style(WHITE.mix(0.8)).label_font(("sans-serif", 11)).draw()
}

/// A label that is not too long to be read.
fn cut(label: &str) -> String {
    let label = label.replace('"', "");
    if label.chars().count() <= LONGEST { label } else { label.chars().take(LONGEST - 1).chain(['…']).collect() }
}

fn room(length: f64) -> f64 {
    if length > 0.0 { length } else { 1.0 }
}

/// 1500000 as 1.5M.
fn shortened(value: f64) -> String {
    let (scaled, unit) = match value.abs() {
        size if size >= 1e9 => (value / 1e9, "G"),
        size if size >= 1e6 => (value / 1e6, "M"),
        size if size >= 1e4 => (value / 1e3, "k"),
        _ => (value, ""),
    };
    let digits = format!("{scaled:.4}");
    format!("{}{unit}", digits.trim_end_matches('0').trim_end_matches('.'))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::tests::sweep;

    fn cost(cost: &str, error: &str) -> Panel {
        Panel::Cost { cost: cost.into(), error: error.into() }
    }

    fn knob(input: &str) -> Panel {
        Panel::Knob { input: input.into(), error: "flip_mean".into() }
    }

    #[test]
    fn every_finite_setting_is_a_point_and_the_front_is_marked() {
        let svg = sweep().to_svg("a sweep", &[cost("fragments", "flip_mean")]).unwrap();
        // Three finite points, two of them on the front and so drawn twice.
        assert_eq!(svg.matches("<circle").count(), 5, "{svg}");
        assert!(svg.contains("a sweep") && svg.contains("fragments, samples") && svg.contains("flip_mean"));
        assert_eq!(svg, sweep().to_svg("a sweep", &[cost("fragments", "flip_mean")]).unwrap());
        let two = sweep().to_svg("a sweep", &[cost("fragments", "flip_mean"), cost("flip_mean", "fragments")]).unwrap();
        assert!(two.matches("<circle").count() > 5);
    }

    #[test]
    fn a_knob_has_its_values_across_and_a_curve_for_each_of_the_others() {
        let mut two = sweep();
        let svg = two.to_svg("", &[knob("shells.layers")]).unwrap();
        // One curve of three points; all four values stand along the axis, and no number between them does.
        assert_eq!((svg.matches("<circle").count(), svg.matches("<polyline").count() >= 1), (3, true), "{svg}");
        let written = |svg: &str, word: &str| svg.lines().filter(|line| line.trim() == word).count();
        assert_eq!(["4", "8", "16", "32", "0.5"].map(|word| written(&svg, word)), [1, 1, 1, 1, 1], "{svg}");
        two.rows[1].settings[1] = "Pixels".into();
        let svg = two.to_svg("", &[knob("shells.layers")]).unwrap();
        assert_eq!((written(&svg, "Pixels"), written(&svg, "Table(size: 4, of: x)")), (1, 1), "{svg}");
    }

    #[test]
    fn groups_have_fronts_of_their_own() {
        let mut grouped = sweep();
        grouped.rows[2].settings[1] = "Pixels".into();
        let alone = grouped.to_svg("", &[cost("fragments", "flip_mean")]).unwrap();
        grouped.grouped_by = vec!["picture.lighting".into()];
        let svg = grouped.to_svg("", &[cost("fragments", "flip_mean")]).unwrap();
        assert_eq!([&alone, &svg].map(|svg| svg.matches("<circle").count()), [5, 6]);
    }

    #[test]
    fn what_cannot_be_drawn_is_refused() {
        assert_eq!(sweep().to_svg("", &[]), Err(AccuracyError::NoValues));
        assert!(matches!(sweep().to_svg("", &[cost("joules", "flip_mean")]), Err(AccuracyError::NoSuchColumn { .. })));
        assert!(matches!(sweep().to_svg("", &[knob("joules")]), Err(AccuracyError::NoSuchColumn { .. })));
        let empty = Sweep { rows: Vec::new(), ..sweep() };
        assert_eq!(empty.to_svg("", &[cost("fragments", "flip_mean")]), Err(AccuracyError::NoValues));
        assert_eq!(empty.to_svg("", &[knob("shells.layers")]), Err(AccuracyError::NoValues));
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([0.0, 0.25, 1500.0, 20_000.0, 1.5e6, 2e9].map(shortened), ["0", "0.25", "1500", "20k", "1.5M", "2G"]);
    }
}
