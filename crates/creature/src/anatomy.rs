//! From a plan to limbs: where each part of a body is.

use glam::DVec3;

use crate::body::Limb;
use crate::cone::Cone;
use crate::plan::{Plan, Stance};
use crate::{Part, legs, tail};

/// How high above the ground everything but the feet is kept.
const CLEARANCE: f64 = 0.02;

/// Limbs as they are put on, trunk first.
pub(crate) struct Anatomy {
    pub(crate) plan: Plan,
    pub(crate) chest: DVec3,
    pub(crate) belly: DVec3,
    pub(crate) rump: DVec3,
    pub(crate) limbs: Vec<Limb>,
}

/// The limbs of a plan whose numbers are in range.
pub(crate) fn limbs(plan: &Plan) -> Vec<Limb> {
    let trunk = plan.trunk;
    let standing = if plan.leg_pairs == 0 { 0.0 } else { 1.0 };
    let chest = DVec3::new(0.0, trunk.chest + standing * plan.legs.fore, 0.5);
    let rump = DVec3::new(0.0, trunk.rump + standing * plan.legs.hind, -0.5);
    let lowest_belly = trunk.belly + standing * CLEARANCE;
    let middle = chest.midpoint(rump) + DVec3::Y * trunk.arch;
    let belly = middle.with_y(middle.y.max(lowest_belly));
    let mut anatomy = Anatomy { plan: *plan, chest, belly, rump, limbs: Vec::new() };
    anatomy.add_trunk();
    anatomy.add_head();
    match plan.stance {
        Stance::Upright => legs::add_upright(&mut anatomy),
        Stance::Sprawling => legs::add_sprawling(&mut anatomy),
    }
    tail::add(&mut anatomy);
    anatomy.limbs
}

impl Anatomy {
    pub(crate) fn add(&mut self, part: Part, cone: Cone, blend: f64) {
        self.limbs.push(Limb { cone, part, blend: blend.max(1e-4) });
    }

    fn add_trunk(&mut self) {
        let trunk = self.plan.trunk;
        let balls = [(self.chest, trunk.chest), (self.belly, trunk.belly), (self.rump, trunk.rump)];
        for pair in balls.windows(2) {
            let cone = Cone::new(pair[0], pair[1], DVec3::NEG_Z).flattened(DVec3::X, trunk.width);
            self.add(Part::Trunk, cone, 0.35 * trunk.belly);
        }
    }

    fn add_head(&mut self) {
        let (neck, head, trunk) = (self.plan.neck, self.plan.head, self.plan.trunk);
        let (sine, cosine) = libm::sincos(neck.pitch.to_radians());
        let rising = DVec3::new(0.0, sine, cosine);
        let centre = above_ground(self.chest + rising * (0.75 * trunk.chest + neck.length), head.radius);
        let base = self.chest + rising * (0.35 * trunk.chest);
        self.add(Part::Neck, Cone::new((centre, neck.thickness), (base, 1.3 * neck.thickness), -rising), 0.6 * neck.thickness);
        let face = Face::new(&self.plan, centre);
        self.add(Part::Head, Cone::new((centre, head.radius), (centre, head.radius), -face.forward), 0.5 * head.radius);
        face.add_muzzle(self);
        face.add_eyes(self);
        face.add_ears(self);
    }
}

/// The head's own frame.
struct Face {
    centre: DVec3,
    radius: f64,
    forward: DVec3,
    up: DVec3,
}

impl Face {
    fn new(plan: &Plan, centre: DVec3) -> Self {
        let (sine, cosine) = libm::sincos(plan.head.pitch.to_radians());
        Self { centre, radius: plan.head.radius, forward: DVec3::new(0.0, -sine, cosine), up: DVec3::new(0.0, cosine, sine) }
    }

    fn add_muzzle(&self, anatomy: &mut Anatomy) {
        let head = anatomy.plan.head;
        let thickness = head.muzzle_thickness * self.radius;
        let root = self.centre + self.radius * (0.25 * self.forward - 0.18 * self.up);
        let out = self.radius * (1.0 + head.muzzle) - thickness;
        let tip = above_ground(self.centre + out * self.forward - 0.28 * self.radius * self.up, thickness);
        let back = (root - tip).normalize_or(-self.forward);
        anatomy.add(Part::Muzzle, Cone::new((tip, thickness), (root, (0.62 * self.radius).max(thickness)), back), 0.35 * self.radius);
        if head.nose > 0.0 {
            let radius = head.nose * thickness;
            let at = tip + thickness * (0.9 * self.forward + 0.3 * self.up);
            let wide = 0.45 * radius * DVec3::X;
            let nose = Cone::new((at - wide, 0.8 * radius), (at + wide, 0.8 * radius), back);
            anatomy.add(Part::Nose, nose, 0.5 * radius);
        }
    }

    fn add_eyes(&self, anatomy: &mut Anatomy) {
        let radius = anatomy.plan.head.eyes * self.radius;
        if radius <= 0.0 {
            return;
        }
        for side in [1.0, -1.0] {
            let towards = (0.78 * self.forward + 0.3 * self.up + side * 0.55 * DVec3::X).normalize();
            let at = self.centre + (self.radius - 0.25 * radius) * towards;
            anatomy.add(Part::Eyes, Cone::new((at, radius), (at, radius), -self.forward), 0.4 * radius);
        }
    }

    fn add_ears(&self, anatomy: &mut Anatomy) {
        let ears = anatomy.plan.ears;
        let length = ears.length * self.radius;
        if length < 0.02 {
            return;
        }
        let width = ears.width * self.radius;
        let hanging = ears.droop.max(ears.spread);
        for side in [1.0, -1.0] {
            let inner = self.ear_direction(side, ears.spread, ears.lean);
            let outer = self.ear_direction(side, hanging, ears.lean);
            // A hanging ear lies along the head, a standing one looks ahead.
            let hangs = ((hanging - ears.spread) / 90.0).min(1.0);
            let facing = self.forward * (1.0 - hangs) + side * hangs * DVec3::X + 0.25 * side * DVec3::X;
            let (base, tip) = ((self.ear_base(side, ears.spread), width), ears.tip * width);
            let half = (base.0 + 0.5 * length * inner, 0.5 * (width + tip));
            let end = (above_ground(half.0 + 0.5 * length * outer, tip), tip);
            for (from, to) in [(base, half), (half, end)] {
                anatomy.add(Part::Ears, Cone::new(from, to, outer).flattened(facing, 0.42), 0.6 * width);
            }
        }
    }

    /// Degrees from the crown to the side, and back.
    fn ear_direction(&self, side: f64, aside: f64, back: f64) -> DVec3 {
        let ((sine, cosine), (lean, stand)) = (libm::sincos(aside.to_radians()), libm::sincos(back.to_radians()));
        (side * sine * DVec3::X + cosine * self.up) * stand - lean * self.forward
    }

    fn ear_base(&self, side: f64, aside: f64) -> DVec3 {
        self.centre + 0.82 * self.radius * self.ear_direction(side, aside, 12.0)
    }
}

/// A ball's centre, raised so that it does not reach into the ground.
pub(crate) fn above_ground(centre: DVec3, radius: f64) -> DVec3 {
    centre.with_y(centre.y.max(radius + CLEARANCE))
}
