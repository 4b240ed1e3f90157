//! Numbers from one range to another.

use crate::error::check;
use crate::{FieldError, ScalarField};

/// How numbers go from the start of the one range to the start of the other, and from end to end; beyond the ends they stay at the end.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// Straight.
    Straight,
    /// Slowly at both ends: 3t² − 2t³.
    Smooth,
    /// Through points (x, y) of the unit square and beyond: x rises strictly, y may be anything. Between them it is the cubic of Fritsch and Carlson (1980), which
    /// has no hills but at points; before the first and after the last it is level.
    Curve(Vec<(f64, f64)>),
    /// Forth and back so many times, 0 to 1000, by a cosine: stripes.
    Waves(f64),
}

impl ScalarField {
    /// Numbers from the range `from` mapped to the range `to`; either may fall.
    ///
    /// # Errors
    /// Where a number is not finite, `from` starts where it ends, or a course is none.
    pub fn remapped(&self, from: (f64, f64), to: (f64, f64), course: &Course) -> Result<Self, FieldError> {
        for (parameter, value) in
            [("the range's start", from.0), ("the range's end", from.1), ("the start to map to", to.0), ("the end to map to", to.1)]
        {
            check(parameter, value, (-f64::from(f32::MAX), f64::from(f32::MAX)))?;
        }
        if from.0 == from.1 {
            return Err(FieldError::EmptyRange(from.0));
        }
        let course = Prepared::of(course)?;
        let map = |value: f32| {
            let t = ((f64::from(value) - from.0) / (from.1 - from.0)).clamp(0.0, 1.0);
            let u = course.at(t);
            ((1.0 - u) * to.0 + u * to.1) as f32
        };
        self.map(map)
    }

    /// 1 where a number is over a threshold, 0 where it is under it, with an edge of width `softness` around it, smooth at both ends.
    ///
    /// # Errors
    /// Where the threshold is not finite, or the softness is negative or none.
    pub fn mask(&self, threshold: f64, softness: f64) -> Result<Self, FieldError> {
        check("the threshold", threshold, (-f64::from(f32::MAX), f64::from(f32::MAX)))?;
        check("the softness", softness, (0.0, f64::from(f32::MAX)))?;
        self.map(|value| {
            let over = f64::from(value) - threshold;
            let t = if softness > 0.0 { (over / softness + 0.5).clamp(0.0, 1.0) } else { f64::from(u8::from(over >= 0.0)) };
            smooth(t) as f32
        })
    }
}

/// 3t² − 2t³.
pub(crate) fn smooth(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}

/// A course with what has to be worked out once.
enum Prepared<'a> {
    Straight,
    Smooth,
    Waves(f64),
    Curve { points: &'a [(f64, f64)], slopes: Vec<f64> },
}

impl<'a> Prepared<'a> {
    fn of(course: &'a Course) -> Result<Self, FieldError> {
        match course {
            Course::Straight => Ok(Self::Straight),
            Course::Smooth => Ok(Self::Smooth),
            Course::Waves(count) => {
                check("the number of waves", *count, (0.0, 1000.0))?;
                Ok(Self::Waves(*count))
            }
            Course::Curve(points) => {
                let is_after = |point: usize| match point.checked_sub(1) {
                    Some(before) => points[point].0 > points[before].0,
                    None => points.len() > 1,
                };
                let usable = |point: usize| is_after(point) && points[point].0.is_finite() && points[point].1.is_finite();
                if let Some(point) = (0..points.len().max(1)).find(|&point| points.is_empty() || !usable(point)) {
                    return Err(FieldError::CurvePoint { point, at: points.get(point).map_or(f64::NAN, |at| at.0) });
                }
                Ok(Self::Curve { points, slopes: slopes(points) })
            }
        }
    }

    fn at(&self, t: f64) -> f64 {
        match self {
            Self::Straight => t,
            Self::Smooth => smooth(t),
            Self::Waves(count) => 0.5 - 0.5 * libm::cos(std::f64::consts::TAU * count * t),
            Self::Curve { points, slopes } => {
                let after = points.partition_point(|point| point.0 <= t);
                let (Some(before), true) = (after.checked_sub(1), after < points.len()) else {
                    return if after == 0 { points[0].1 } else { points[points.len() - 1].1 };
                };
                between(points[before], points[after], (slopes[before], slopes[after]), t)
            }
        }
    }
}

/// The slope at each point that keeps each stretch rising or falling as its ends do.
fn slopes(points: &[(f64, f64)]) -> Vec<f64> {
    let chords: Vec<(f64, f64)> = points.windows(2).map(|p| (p[1].0 - p[0].0, (p[1].1 - p[0].1) / (p[1].0 - p[0].0))).collect();
    let mut slopes = vec![0.0; points.len()];
    let last = points.len() - 1;
    (slopes[0], slopes[last]) = (chords[0].1, chords[last - 1].1);
    for k in 1..last {
        let ((left_width, left), (right_width, right)) = (chords[k - 1], chords[k]);
        if left * right > 0.0 {
            // The harmonic mean, weighted by widths as Fritsch and Butland have it.
            let (a, b) = (2.0 * right_width + left_width, right_width + 2.0 * left_width);
            slopes[k] = (a + b) / (a / left + b / right);
        }
    }
    slopes
}

/// The cubic between two points with given slopes.
fn between(from: (f64, f64), to: (f64, f64), slopes: (f64, f64), x: f64) -> f64 {
    let width = to.0 - from.0;
    let t = (x - from.0) / width;
    let (rest, whole) = (1.0 - t, smooth(t));
    from.1 * (1.0 - whole) + to.1 * whole + width * t * rest * (slopes.0 * rest - slopes.1 * t)
}
