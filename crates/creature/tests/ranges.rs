//! Every proportion at and beyond both ends of its range.

use pelage_creature::{Creature, CreatureError, FEWEST_FACES, MOST_FACES, MOST_LEG_PAIRS, Plan, Species, Stance};
use pelage_mesh::Summary;
use proptest::prelude::*;

/// A plan of the species with one number replaced by what a function makes of its range.
fn with(species: Species, number: usize, value: impl Fn(f64, f64) -> f64) -> (Plan, &'static str) {
    let mut plan = species.plan();
    let mut numbers = plan.proportions();
    let chosen = &mut numbers[number];
    *chosen.value = value(*chosen.range.start(), *chosen.range.end());
    let name = chosen.name;
    (plan, name)
}

fn expect_ball(creature: &Creature, what: &str) {
    let summary = Summary::of(creature.mesh());
    assert!(summary.is_closed() && (summary.components, summary.genus) == (1, 0), "{what}: {summary:?}");
    assert!(summary.signed_volume > 0.0 && summary.faces_without_area == 0, "{what}");
}

const NUMBERS: usize = 36;

#[test]
fn there_are_as_many_numbers_as_the_tests_try() {
    assert_eq!(Species::Cat.plan().proportions().len(), NUMBERS);
}

/// Each number of one species or another, at one end or the other.
#[test]
fn a_number_at_an_end_of_its_range_makes_a_whole_creature() {
    for number in 0..NUMBERS {
        let species = Species::ALL[number * 3 % Species::ALL.len()];
        let (plan, name) = with(species, number, |low, high| if number % 2 == 0 { low } else { high });
        let what = format!("{} with {name} at an end", species.name());
        match Creature::new(&plan, 1_000) {
            Ok(creature) => expect_ball(&creature, &what),
            Err(error) => panic!("{what}: {error}"),
        }
    }
}

#[test]
fn a_number_past_an_end_is_named() {
    for species in [Species::Cat, Species::Spider] {
        for number in 0..NUMBERS {
            let bad: [fn(f64, f64) -> f64; 4] = [|low, _| low - 1e-9, |_, high| high + 1e-9, |_, _| f64::NAN, |_, _| f64::INFINITY];
            for value in bad {
                let (plan, expected) = with(species, number, value);
                match Creature::new(&plan, 1_000) {
                    Err(CreatureError::OutOfRange { name, range, .. }) => assert!(name == expected && range.start() < range.end()),
                    other => panic!("{expected}: {:?}", other.err()),
                }
            }
        }
    }
}

#[test]
fn faces_pairs_variation_have_ranges_too() {
    let name = |result: Result<Creature, CreatureError>| match result {
        Err(CreatureError::OutOfRange { name, .. }) => name,
        _ => "none",
    };
    let plan = Species::Bear.plan();
    assert_eq!(name(Creature::new(&plan, FEWEST_FACES - 1)), "faces");
    assert_eq!(name(Creature::new(&plan, MOST_FACES + 1)), "faces");
    assert_eq!(name(Creature::new(&Plan { leg_pairs: MOST_LEG_PAIRS + 1, ..plan }, 1_000)), "leg_pairs");
    assert!(plan.individual(1, 0.51).is_err() && plan.individual(1, -0.01).is_err() && plan.individual(1, f64::NAN).is_err());
}

#[test]
fn any_number_of_legs_stands() -> Result<(), CreatureError> {
    // More upright legs than four pairs of a cat's touch each other.
    let (cat, spider) = ((Species::Cat, Stance::Upright), (Species::Spider, Stance::Sprawling));
    for (leg_pairs, kinds) in
        [(0, vec![cat, spider]), (1, vec![cat, spider]), (3, vec![cat]), (4, vec![cat]), (MOST_LEG_PAIRS, vec![spider])]
    {
        for (species, stance) in kinds {
            let creature = Creature::new(&Plan { leg_pairs, stance, ..species.plan() }, 3_000)?;
            let what = format!("a {} with {leg_pairs} pairs of legs", species.name());
            expect_ball(&creature, &what);
            let low = creature.mesh().bounds().unwrap_or_default().0.y;
            assert!(low.abs() < 0.02, "{what}: lowest at {low}");
        }
    }
    Ok(())
}

/// A rabbit's long ears, leant back as far as they go, lie on its back.
#[test]
fn parts_that_enclose_a_hole_are_told() {
    let mut plan = Species::Rabbit.plan();
    plan.ears.lean = 70.0;
    match Creature::new(&plan, 1_000) {
        Err(CreatureError::Fused { handles, pieces }) => assert!(handles > 0 && pieces == 1),
        other => panic!("{:?}", other.map(|creature| Summary::of(creature.mesh()))),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]

    /// Whatever is in range makes a whole creature, or says in words of the plan why it does not.
    #[test]
    fn any_plan_in_range_is_whole_or_told(
        places in proptest::collection::vec(0.0..=1.0_f64, NUMBERS), species in 0..Species::ALL.len(), pairs in 0..=MOST_LEG_PAIRS, sprawling in any::<bool>(),
    ) {
        let mut plan = Species::ALL[species].plan();
        for (number, place) in plan.proportions().into_iter().zip(places) {
            *number.value = number.range.start() + place * (number.range.end() - number.range.start());
        }
        plan.leg_pairs = pairs;
        plan.stance = if sprawling { Stance::Sprawling } else { Stance::Upright };
        match Creature::new(&plan, 1_500) {
            Ok(creature) => expect_ball(&creature, "a random plan"),
            Err(CreatureError::Fused { handles, pieces }) => prop_assert!(handles > 0 || pieces > 1),
            Err(CreatureError::TooCoarse { asked, reached }) => prop_assert!(reached > asked),
            Err(other) => prop_assert!(false, "{other}"),
        }
    }
}
