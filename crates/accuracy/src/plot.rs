//! The plot of a sweep: error over cost.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::{AccuracyError, Sweep, pareto_front};

/// One diagram of a plot: an error over a cost.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Panel {
    /// The column across.
    pub cost: String,
    /// The column upwards.
    pub error: String,
}

/// Pixels of a panel.
const PANEL: (u32, u32) = (460, 360);
const POINT: RGBColor = RGBColor(130, 130, 130);
const FRONT: RGBColor = RGBColor(31, 119, 180);

impl Sweep {
    /// The sweep as SVG, a diagram for each panel, side by side under the title: each setting a point labelled by its values, with a line along those that no other beats.
    ///
    /// # Errors
    ///
    /// Those of [`check`](Self::check); [`NoSuchColumn`](AccuracyError::NoSuchColumn), and [`NoValues`](AccuracyError::NoValues) for a plot without a panel, or a panel without a point.
    pub fn to_svg(&self, title: &str, panels: &[Panel]) -> Result<String, AccuracyError> {
        if panels.is_empty() {
            return Err(AccuracyError::NoValues);
        }
        let failed = |error: DrawingAreaErrorKind<_>| AccuracyError::Plot(error.to_string());
        let mut text = String::new();
        {
            let root = SVGBackend::with_string(&mut text, (PANEL.0 * panels.len() as u32, PANEL.1 + 30)).into_drawing_area();
            root.fill(&WHITE).map_err(failed)?;
            let body = root.titled(title, ("sans-serif", 18)).map_err(failed)?;
            for (panel, area) in panels.iter().zip(body.split_evenly((1, panels.len()))) {
                self.draw(panel, &area)?;
            }
            root.present().map_err(failed)?;
        }
        Ok(text)
    }

    fn draw(&self, panel: &Panel, area: &DrawingArea<SVGBackend<'_>, Shift>) -> Result<(), AccuracyError> {
        let points = self.points(&panel.cost, &panel.error)?;
        let finite = || points.iter().filter(|point| point.0.is_finite() && point.1.is_finite());
        if finite().next().is_none() {
            return Err(AccuracyError::NoValues);
        }
        let end = |of: fn(&(f64, f64)) -> f64| finite().map(of).fold(0.0, f64::max);
        // Room for the labels to the right of the last point; an axis has some length.
        let (across, upwards) = (room(1.25 * end(|point| point.0)), room(1.1 * end(|point| point.1)));
        let (cost, error) = (&self.columns[self.column(&panel.cost)?], &self.columns[self.column(&panel.error)?]);
        let front: Vec<(f64, f64)> = pareto_front(&points).into_iter().map(|index| points[index]).collect();
        let labelled = points.iter().zip(&self.rows).filter(|(point, _)| point.0.is_finite() && point.1.is_finite());
        let labels = labelled.map(|(&point, row)| (point, row.settings.join(", ")));
        let draw = || -> Result<(), DrawingAreaErrorKind<_>> {
            let mut chart = ChartBuilder::on(area)
                .margin(12)
                .x_label_area_size(40)
                .y_label_area_size(62)
                .build_cartesian_2d(0.0..across, 0.0..upwards)?;
            let (x, y) = (format!("{}, {}", cost.name, cost.unit), format!("{}, {}", error.name, error.unit));
            let short = |value: &f64| shortened(*value);
            chart
                .configure_mesh()
                .x_desc(x)
                .y_desc(y)
                .x_labels(5)
                .x_label_formatter(&short)
                .y_label_formatter(&short)
                .label_style(("sans-serif", 12))
                .light_line_style(TRANSPARENT)
                .draw()?;
            chart.draw_series(finite().map(|&point| Circle::new(point, 3, POINT.filled())))?;
            chart.draw_series(LineSeries::new(front.iter().copied(), FRONT.stroke_width(2)))?;
            chart.draw_series(front.iter().map(|&point| Circle::new(point, 4, FRONT.filled())))?;
            chart.draw_series(labels.map(|(point, label)| EmptyElement::at(point) + Text::new(label, (6, -12), ("sans-serif", 11))))?;
            Ok(())
        };
        draw().map_err(|error| AccuracyError::Plot(error.to_string()))
    }
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

    fn panel(cost: &str, error: &str) -> Panel {
        Panel { cost: cost.into(), error: error.into() }
    }

    #[test]
    fn every_finite_setting_is_a_point_and_the_front_is_marked() {
        let svg = sweep().to_svg("a sweep", &[panel("fragments", "flip_mean")]).unwrap();
        // Three finite points, two of them on the front and so drawn twice.
        assert_eq!(svg.matches("<circle").count(), 5, "{svg}");
        assert!(svg.contains("a sweep") && svg.contains("fragments, samples") && svg.contains("flip_mean"));
        assert_eq!(svg, sweep().to_svg("a sweep", &[panel("fragments", "flip_mean")]).unwrap());
        let two = sweep().to_svg("a sweep", &[panel("fragments", "flip_mean"), panel("flip_mean", "fragments")]).unwrap();
        assert!(two.matches("<circle").count() > 5);
    }

    #[test]
    fn what_cannot_be_drawn_is_refused() {
        assert_eq!(sweep().to_svg("", &[]), Err(AccuracyError::NoValues));
        assert!(matches!(sweep().to_svg("", &[panel("joules", "flip_mean")]), Err(AccuracyError::NoSuchColumn { .. })));
        let empty = Sweep { rows: Vec::new(), ..sweep() };
        assert_eq!(empty.to_svg("", &[panel("fragments", "flip_mean")]), Err(AccuracyError::NoValues));
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([0.0, 0.25, 1500.0, 20_000.0, 1.5e6, 2e9].map(shortened), ["0", "0.25", "1500", "20k", "1.5M", "2G"]);
    }
}
