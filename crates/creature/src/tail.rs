//! A tail.

use glam::DVec3;

use crate::Part;
use crate::anatomy::{Anatomy, above_ground};
use crate::cone::Cone;

/// Cones that a tail is made of.
const JOINTS: u32 = 12;

/// Adds the tail of a plan that has one.
pub(crate) fn add(anatomy: &mut Anatomy) {
    let (tail, trunk) = (anatomy.plan.tail, anatomy.plan.trunk);
    if tail.length < 0.02 {
        return;
    }
    let step = tail.length / f64::from(JOINTS);
    let mut at = anatomy.rump + trunk.rump * DVec3::new(0.0, 0.5, -0.62);
    for joint in 0..JOINTS {
        let [begin, middle, end] = [0.0, 0.5, 1.0].map(|k| (f64::from(joint) + k) / f64::from(JOINTS));
        let way = direction(tail.pitch + tail.curl * middle, tail.sway * middle);
        let [from, to] = [begin, end].map(|t| tail.thickness * profile(t, tail.bush, tail.tip));
        let next = above_ground(at + step * way, to);
        let part = if begin < 0.75 { Part::Tail } else { Part::TailTip };
        let blend = if joint == 0 { tail.thickness } else { 0.25 * from };
        anatomy.add(part, Cone::new((above_ground(at, from), from), (next, to), way), blend);
        at = next;
    }
}

/// Backwards, risen by so many degrees and turned to the left.
fn direction(rise: f64, aside: f64) -> DVec3 {
    let ((sine, cosine), (left, straight)) = (libm::sincos(rise.to_radians()), libm::sincos(aside.to_radians()));
    DVec3::new(cosine * left, sine, -cosine * straight)
}

/// The radius along a tail, in radii of its base: to the bush at two thirds, then to the tip.
fn profile(t: f64, bush: f64, tip: f64) -> f64 {
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let swell = 2.0 / 3.0;
    if t < swell { 1.0 + (bush - 1.0) * smooth(t / swell) } else { bush * (1.0 + (tip - 1.0) * smooth((t - swell) / (1.0 - swell))) }
}
