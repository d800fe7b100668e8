//! Cables with materials of their own, beside what the reference cases say: the common material is one way to say the same.
#![cfg(feature = "scenario")]

use tautline::robot::{OwnMaterial, Strain};
use tautline::scenario::json::Material;
use tautline::scenario::{Report, Scenario, presets};

fn report(scenario: &Scenario) -> Report {
    let (robot, motion) = scenario.to_robot().expect("a physical scenario");
    Report::analyze(&robot, &motion, 40.0)
}

/// `material` as what one cable has of its own.
fn all_of(material: Material) -> OwnMaterial {
    let Material { youngs_modulus, area, mass_per_length, strain } = material;
    OwnMaterial {
        youngs_modulus: Some(youngs_modulus),
        area: Some(area),
        mass_per_length: Some(mass_per_length),
        strain: Some(strain),
    }
}

/// Not a bit of any number changes, so the code for own materials is the code for common ones.
#[test]
fn own_values_that_are_the_common_ones_change_no_bit() {
    for preset in presets::PRESETS {
        let scenario = preset.scenario();
        let mut own = scenario.clone();
        for cable in &mut own.cables {
            cable.cable = all_of(scenario.cable);
        }
        // The common values that nobody uses any more do not matter.
        own.cable = Material { youngs_modulus: 7e8, area: 3e-4, mass_per_length: 0.9, strain: Strain::Engineering };
        let [common, own] = [&scenario, &own].map(|scenario| {
            // Equal texts, so that zeros of both signs differ.
            serde_json::to_string(&report(scenario)).expect("JSON")
        });
        assert_eq!(common, own, "{}", preset.name);
    }
}

/// Each value of one cable is heard by that cable: its unstretched length is another one. Prescribed tensions of the others
/// stay, and so do their shapes.
#[test]
fn every_own_value_counts() {
    let scenario = presets::PRESETS[0].scenario();
    let before = report(&scenario);
    let changes: [fn(&mut OwnMaterial); 4] = [
        |own| own.youngs_modulus = Some(2e8),
        |own| own.area = Some(8e-5),
        |own| own.mass_per_length = Some(0.2),
        |own| own.strain = Some(Strain::Engineering),
    ];
    for change in changes {
        let mut changed = scenario.clone();
        change(&mut changed.cables[2].cable);
        let after = report(&changed);
        let length = |report: &Report, cable: usize| report.cables[cable].unstretched_length;
        assert!((length(&after, 2) - length(&before, 2)).abs() > 1e-6, "{:?}", changed.cables[2].cable);
        assert_eq!(after.cables[3], before.cables[3], "{:?}", changed.cables[2].cable);
        let speed = |report: &Report| report.critical.as_ref().expect("a critical speed").speed;
        assert!((speed(&after) - speed(&before)).abs() > 1e-6, "{:?}", changed.cables[2].cable);
    }
}
