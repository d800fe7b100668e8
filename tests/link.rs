//! Links: nothing is lost, damage is told, and those made once stay readable.
#![cfg(feature = "scenario")]

use std::fs;
use std::time::{Duration, Instant};

use proptest::prelude::*;
use tautline::robot::{Damping, Faults, Linearisation, OwnMaterial, Strain, TensionLaw};
use tautline::scenario::json::{Cable, Material, Motion, Platform};
use tautline::scenario::link::{self, LinkError};
use tautline::scenario::{Corners, Path, ProfileKind, Scenario, presets};

/// The signs of base64url in the order of their values.
const SIGNS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

fn paper() -> Scenario {
    presets::find("paper").unwrap().scenario()
}

/// A link as the format's description has it, around any bytes: by other means than the library's.
fn around(fields: &[u8]) -> String {
    of_version("1", fields)
}

/// The same of the second version, in which cables may have a material of their own.
fn around_second(fields: &[u8]) -> String {
    of_version("2", fields)
}

/// The same of the third version, in which there is a path.
fn around_third(fields: &[u8]) -> String {
    of_version("3", fields)
}

fn of_version(mark: &str, fields: &[u8]) -> String {
    let crc = [mark.as_bytes(), fields]
        .concat()
        .iter()
        .fold(!0_u32, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 * (crc & 1))));
    let bytes = [fields, &(!crc).to_le_bytes()].concat();
    let bits: Vec<u8> = bytes.iter().flat_map(|byte| (0..8).rev().map(move |bit| byte >> bit & 1)).collect();
    let sign = |bits: &[u8]| {
        let value = (0..6).fold(0, |value, i| 2 * value + bits.get(i).copied().unwrap_or(0));
        char::from(SIGNS[usize::from(value)])
    };
    [mark.to_owned(), bits.chunks(6).map(sign).collect()].concat()
}

/// The paper's robot by hand. Up to the count of cables: named, Green, secant; 9.81 as z = 2 · 981 and k = 3, so 15699.
const HEAD: &[u8] = b"\x01\x0bPaper robot\xd3\x7a\xd7\x0f\x06\x50\x44\x25";
/// Its four cables: −10 and 10 are −1 and 1 with k = 6, 45 takes two bytes.
const CABLES: [&[u8]; 4] = [
    &[0x0e, 0x55, 0],
    &[0x16, 0x55, 0],
    &[0x0e, 0x4d, 2, 0x56, 0x55, 0x05, 0xd5, 0x05, 0x05, 0x05],
    &[0x16, 0x4d, 2, 0x56, 0x4d, 0x05, 0xd5, 0x05, 0x05, 0x05],
];
/// All that is behind them.
const TAIL: &[u8] = &[10, 0x54, 0x52, 0x05, 0x05, 0x15, 0x05, 0x55];

/// The paper's robot with these cables, said to be `count` in LEB128.
fn with_cables(count: &[u8], cables: &[&[u8]]) -> Vec<u8> {
    [HEAD, count, &cables.concat(), TAIL].concat()
}

fn not_physical(link: &str) -> Faults {
    match link::decode(link) {
        Err(LinkError::NotPhysical(faults)) => faults,
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_format_is_the_one_described() {
    let by_hand = around(&with_cables(&[4], &CABLES));
    assert_eq!(link::encode(&paper()), by_hand);
    assert_eq!(link::decode(&by_hand), Ok(paper()));
}

/// The paper's robot in the second version: what cables have of their own stands behind their tensions.
#[test]
fn own_materials_are_in_the_second_version() {
    let mut scenario = paper();
    // E = 2e8, so m = 2 with an exponent of 8: beyond those that k tells.
    scenario.cables[0].cable.youngs_modulus = Some(2e8);
    scenario.cables[2].cable = OwnMaterial {
        area: Some(3e-5),
        mass_per_length: Some(0.2),
        strain: Some(Strain::Engineering),
        ..OwnMaterial::default()
    };
    scenario.cables[3].cable.strain = Some(Strain::Green);
    let own: [&[u8]; 4] = [&[1, 0x27, 8], &[0], &[2 + 4 + 16, 0x30, 0x24], &[8]];
    let cables: Vec<Vec<u8>> = CABLES.iter().zip(own).map(|(cable, own)| [cable, own].concat()).collect();
    let cables: Vec<&[u8]> = cables.iter().map(Vec::as_slice).collect();
    let by_hand = around_second(&with_cables(&[4], &cables));
    assert_eq!(link::encode(&scenario), by_hand);
    assert_eq!(link::decode(&by_hand), Ok(scenario.clone()));
    // The same bytes as if they were of the first version are no scenario, nor is a mark that was changed.
    assert_eq!(link::decode(&around(&with_cables(&[4], &cables))), Err(LinkError::Damaged));
    assert_eq!(link::decode(&format!("1{}", &by_hand[1..])), Err(LinkError::Damaged));
    // A scenario without own materials may be said in the second version; it is written in the first.
    let none: Vec<Vec<u8>> = CABLES.iter().map(|cable| [cable, &[0_u8][..]].concat()).collect();
    let none: Vec<&[u8]> = none.iter().map(Vec::as_slice).collect();
    assert_eq!(link::decode(&around_second(&with_cables(&[4], &none))), Ok(paper()));
    assert!(link::encode(&paper()).starts_with('1'));
    // Two strain laws at once, a flag that means nothing, and a number that is not there.
    for wrong in [&[24_u8][..], &[32], &[255], &[1]] {
        let mut cables = none.clone();
        let last = [CABLES[3], wrong].concat();
        cables[3] = &last;
        assert_eq!(link::decode(&around_second(&with_cables(&[4], &cables))), Err(LinkError::Damaged), "{wrong:?}");
    }
    // What is not physical has the path that it has in a file.
    scenario.cables[2].cable.area = Some(-1.0);
    let faults = not_physical(&link::encode(&scenario));
    assert_eq!((faults.list()[0].path.as_str(), faults.list().len()), ("cables[2].cable.area", 1));
}

/// The cables of [`CABLES`], each without anything of its own, as they are from the second version on.
fn without_own() -> Vec<u8> {
    CABLES.iter().flat_map(|cable| [cable, &[0_u8][..]].concat()).collect()
}

/// The paper's robot in the third version with these bytes of a path.
fn with_path(path: &[u8]) -> String {
    around_third(&[&with_cables(&[4], &[&without_own()]), path].concat())
}

/// The path stands behind everything else.
#[test]
fn paths_are_in_the_third_version() {
    // 6 and 0; a speed of 5, an acceleration of 1, a jerk of 10, which is 1 with k = 6, a hold of 2.
    let straight = Path { hold: 2.0, ..Path::new(vec![[6.0, 0.0]], 5.0) };
    let smooth = Path {
        corners: Corners::Smooth,
        profile: ProfileKind::Scurve,
        acceleration: 3.0,
        jerk: 8.0,
        ..Path::new(vec![[6.0, 0.1], [-1.5, -2.0]], 4.0)
    };
    let trapezoid = Path { profile: ProfileKind::Trapezoid, ..straight.clone() };
    let constant = Path { profile: ProfileKind::Constant, hold: 0.0, ..straight.clone() };
    for (path, bytes) in [
        (straight.clone(), &[0, 1, 0x65, 0x05, 0x55, 0x15, 0x16, 0x25][..]),
        (trapezoid, &[1, 1, 0x65, 0x05, 0x55, 0x15, 0x16, 0x25]),
        (constant, &[3, 1, 0x65, 0x05, 0x55, 0x15, 0x16, 0x05]),
        // −1.5 and 8 take two bytes.
        (smooth, &[2 + 4, 2, 0x65, 0x14, 0xec, 0x01, 0x1d, 0x45, 0x35, 0x85, 0x01, 0x05]),
    ] {
        let scenario = Scenario { path: Some(path), ..paper() };
        let by_hand = with_path(bytes);
        assert_eq!(link::encode(&scenario), by_hand);
        assert_eq!(link::decode(&by_hand), Ok(scenario));
        // An older mark on it is damage.
        for mark in ['1', '2'] {
            assert_eq!(link::decode(&format!("{mark}{}", &by_hand[1..])), Err(LinkError::Damaged));
        }
    }
    // Cables may have something of their own beside it, and without a path the older versions are written.
    let mut both = Scenario { path: Some(straight), ..paper() };
    both.cables[0].cable.youngs_modulus = Some(2e8);
    let own = [CABLES[0], &[1, 0x27, 8], &without_own()[CABLES[0].len() + 1..]].concat();
    let path = [0, 1, 0x65, 0x05, 0x55, 0x15, 0x16, 0x25];
    assert_eq!(link::encode(&both), around_third(&[&with_cables(&[4], &[&own]), &path[..]].concat()));
    both.path = None;
    assert_eq!((link::encode(&both).chars().next(), link::encode(&paper()).chars().next()), (Some('2'), Some('1')));
    // No path, an unknown profile or flag, too few points, one that is not there, a byte too many.
    for wrong in [
        &[][..],
        &[8, 1, 0x65, 0x05, 0x55, 0x15, 0x16, 0x25],
        &[0xff, 1, 0x65, 0x05, 0x55, 0x15, 0x16, 0x25],
        &[0, 2, 0x65, 0x05, 0x55, 0x15, 0x16, 0x25],
        &[0, 1, 0x65, 0x05, 0x55, 0x15, 0x16],
        &[0, 1, 0x65, 0x05, 0x55, 0x15, 0x16, 0x25, 0],
    ] {
        assert_eq!(link::decode(&with_path(wrong)), Err(LinkError::Damaged), "{wrong:02x?}");
    }
    // What cannot be has the path that it has in a file.
    for (bytes, field) in [
        (&[0, 0, 0x55, 0x15, 0x16, 0x25][..], "path.points"),
        (&[0, 1, 0x05, 0x05, 0x55, 0x15, 0x16, 0x25], "path.points[0]"),
        (&[0, 1, 0x65, 0x05, 0x05, 0x15, 0x16, 0x25], "path.speed"),
        (&[3, 1, 0x65, 0x05, 0x55, 0x15, 0x16, 0x25], "path.hold"),
    ] {
        let faults = not_physical(&with_path(bytes));
        assert_eq!((faults.list()[0].path.as_str(), faults.list().len()), (field, 1), "{faults}");
    }
}

/// Scenarios and their links as they were when the format was made: fixtures, never to be renewed.
#[test]
fn links_made_long_ago_stay_readable() {
    let mut read = 0;
    for entry in fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/links")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "json") {
            let scenario = Scenario::from_json(&fs::read_to_string(&path).unwrap()).unwrap();
            let link = fs::read_to_string(path.with_extension("link")).unwrap();
            let read_again = link::decode(link.strip_prefix(link::MARK).unwrap()).unwrap();
            assert_eq!(read_again, scenario, "{}", path.display());
            // Zeros of both signs are equal, their texts are not.
            assert_eq!(read_again.to_json(), scenario.to_json(), "{}", path.display());
            // What is written today is what was written then.
            assert_eq!(format!("{}{}", link::MARK, link::encode(&scenario)), link.trim_end(), "{}", path.display());
            read += 1;
        }
    }
    assert_eq!(read, 10);
}

#[test]
fn links_are_short_and_safe_in_an_address() {
    assert!(link::encode(&paper()).len() <= 81);
    for preset in presets::PRESETS {
        let mut scenario = preset.scenario();
        let link = link::encode(&scenario);
        assert!(link.len() <= 110, "{}: {}", preset.name, link.len());
        assert!(link.bytes().all(|sign| SIGNS.contains(&sign)), "{link}");
        // Dragged: with all digits in position, direction and speed.
        let motion = Motion { position: [0.1_f64.sin(), 0.2_f64.sin()], direction: [0.6, -0.8], speed: 0.3_f64.exp() };
        scenario.motion = Motion { direction: motion.direction.map(|part| part / 0.999_999_9), ..motion };
        assert!(link::encode(&scenario).len() <= 165, "{}", link::encode(&scenario).len());
    }
}

#[test]
fn every_damage_is_told() {
    let message = LinkError::Damaged.to_string();
    assert!(message.starts_with("This link is damaged: ") && message.lines().count() == 1, "{message}");
    let mut own = paper();
    own.cables[1].cable.area = Some(3e-5);
    let path = Scenario { path: Some(Path::new(vec![[6.0, 0.0], [6.0, 1.5]], 4.0)), ..paper() };
    for scenario in presets::PRESETS.iter().map(presets::Preset::scenario).chain([own, path]) {
        let link = link::encode(&scenario);
        let refused = |damaged: &str| {
            let newer = damaged.starts_with(|c| ('4'..='9').contains(&c));
            let expected = if newer { LinkError::Newer } else { LinkError::Damaged };
            assert_eq!(link::decode(damaged), Err(expected), "{damaged}");
        };
        for at in 0..link.len() {
            let (before, after) = (&link[..at], &link[at..]);
            // Cut short, without its beginning, without this character, with another one in its place or before it.
            refused(before);
            if at > 0 {
                refused(after);
            }
            refused(&format!("{before}{}", &after[1..]));
            for sign in SIGNS.iter().copied().chain(*b".,;% =+/~#\0").map(char::from).chain(['é']) {
                if !after.starts_with(sign) {
                    refused(&format!("{before}{sign}{}", &after[1..]));
                }
                // Spaces in front are not part of it.
                if at > 0 || sign != ' ' {
                    refused(&format!("{before}{sign}{after}"));
                }
            }
            for run in 2..=4_usize.min(after.len()) {
                let mut turned: Vec<u8> = after.bytes().collect();
                turned[..run].reverse();
                let turned = String::from_utf8(turned).unwrap();
                if turned != after {
                    refused(&format!("{before}{turned}"));
                }
            }
        }
        for sign in SIGNS.iter().map(|sign| char::from(*sign)) {
            refused(&format!("{link}{sign}"));
        }
    }
}

#[test]
fn what_programs_add_to_links_is_overlooked() {
    let link = link::encode(&paper());
    for tail in [".", ",", ";", ")", "]", ">", " ", "\n", "\r\n", ").", " >", "%20", "%29.", "\u{a0}", "…", "\"", "*"]
    {
        assert_eq!(link::decode(&format!("{link}{tail}")), Ok(paper()), "{tail:?}");
    }
    assert_eq!(link::decode(&format!(" {link}")), Ok(paper()));
    let encoded = link.bytes().fold(String::new(), |encoded, byte| format!("{encoded}%{byte:02x}"));
    assert_eq!(link::decode(&encoded), Ok(paper()));
}

#[test]
fn what_a_link_says_of_the_view_is_no_part_of_the_robot() {
    let link = link::encode(&paper());
    for view in
        ["&plot=line&map=speed&panels=0&tour=0&theme=dark&present=1", "&", "&amp;plot=line", "%26plot=line", "&x=%ff&&"]
    {
        assert_eq!(link::decode(&format!("{link}{view}")), Ok(paper()), "{view:?}");
    }
    // A damaged robot is not made whole by it.
    let damaged = format!("{}&plot=line", &link[..link.len() - 4]);
    assert_eq!(link::decode(&damaged), Err(LinkError::Damaged));
}

#[test]
fn links_of_later_formats_are_told() {
    assert!(LinkError::Newer.to_string().contains("newer version of Tautline"));
    let link = link::encode(&paper());
    for mark in '4'..='9' {
        assert_eq!(link::decode(&format!("{mark}{}", &link[1..])), Err(LinkError::Newer));
        assert_eq!(link::decode(&mark.to_string()), Err(LinkError::Newer));
    }
    for text in ["", "0", "A", "~", "é", "%", "#s=", "=", "null", "11"] {
        assert_eq!(link::decode(text), Err(LinkError::Damaged), "{text:?}");
    }
}

#[test]
fn forged_links_get_the_errors_of_files() {
    let mut forged = paper();
    (forged.platform.mass, forged.motion.speed, forged.elements_per_cable) = (-2.5, -0.125, 300);
    forged.cables[1].anchor = forged.cables[0].anchor;
    let of_link = not_physical(&link::encode(&forged));
    let of_file = Scenario::from_json(&forged.to_json()).unwrap_err();
    assert_eq!(of_link.to_string().replace("-10.0, 5.0", "…"), of_file.to_string().replace("-10.0, 5.0", "…"));
    assert_eq!(of_link.list().len(), 4, "{of_link}");

    // More cables than are allowed, and elements by the billion.
    let nine = [&CABLES[..], &CABLES[..], &CABLES[..1]].concat();
    let faults = not_physical(&around(&with_cables(&[9], &nine)));
    assert!(
        faults.list().iter().any(|fault| fault.value == "a list of 9" && fault.allowed == "3 to 8 cables".into()),
        "{faults}"
    );
    let mut many = paper();
    many.elements_per_cable = usize::MAX;
    let faults = not_physical(&link::encode(&many));
    assert_eq!((faults.list()[0].path.as_str(), faults.list().len()), ("elements_per_cable", 1), "{faults}");

    // Numbers that a file cannot even hold.
    for (value, text) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf"), (f64::NEG_INFINITY, "-inf")] {
        let mut forged = paper();
        (forged.gravity, forged.motion.position[1]) = (value, value);
        let faults = not_physical(&link::encode(&forged));
        let told: Vec<_> = faults.list().iter().map(|fault| (fault.path.as_str(), fault.value.as_str())).collect();
        assert_eq!(told, [("gravity", text), ("motion.position[1]", text)]);
    }
}

#[test]
fn bytes_that_are_no_scenario_are_damage() {
    let huge = [&[0xff_u8; 9][..], &[1]].concat(); // 2⁶⁴ − 1
    let beyond = [&[0xff_u8; 9][..], &[2]].concat();
    let endless = [0x80_u8; 40];
    let mut kind = CABLES;
    kind[1] = &[0x16, 0x55, 3];
    for bytes in [
        Vec::new(),
        with_cables(&huge, &CABLES),
        with_cables(&beyond, &CABLES),
        with_cables(&endless, &CABLES),
        with_cables(&[3], &CABLES),
        with_cables(&[5], &CABLES),
        with_cables(&[4], &kind),
        [&with_cables(&[4], &CABLES)[..], &[0]].concat(),
        [&[8], &with_cables(&[4], &CABLES)[1..]].concat(),
        [&[1], &huge[..], &HEAD[2..]].concat(),
        [&[1, 2, 0xc3, 0x28], &with_cables(&[4], &CABLES)[13..]].concat(), // not UTF-8
    ] {
        assert_eq!(link::decode(&around(&bytes)), Err(LinkError::Damaged), "{bytes:02x?}");
    }
}

#[test]
fn long_texts_are_refused_at_once() {
    let start = Instant::now();
    let name = "x".repeat(1_000_000);
    let long = Scenario { name: Some(name), ..paper() };
    assert_eq!(link::decode(&link::encode(&long)), Ok(long));
    for unit in ["1", "A", "%", "%31", "é", ".", "1A.", " ", "\u{10ffff}"] {
        assert_eq!(link::decode(&unit.repeat(1_000_000)), Err(LinkError::Damaged), "{unit:?}");
        assert!(link::decode(&format!("1{}", unit.repeat(1_000_000))).is_err(), "{unit:?}");
    }
    // Every cable in it is there, and each is at the same place.
    let cables = vec![CABLES[0]; 200_000];
    assert!(not_physical(&around(&with_cables(&[0xc0, 0x9a, 0x0c], &cables))).list().len() < 100);
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}

fn any_finite() -> impl Strategy<Value = f64> {
    use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    prop_oneof![
        POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO,
        // As people type them, and small and large whole ones.
        (-2000_i32..2000, -12..12).prop_map(|(m, e)| format!("{m}e{e}").parse().unwrap()),
        any::<i64>().prop_map(|whole| whole as f64),
        Just(-0.0),
    ]
}

fn not_negative() -> impl Strategy<Value = f64> {
    // |−0| would be 0, and −0 is allowed.
    prop_oneof![3 => any_finite().prop_map(f64::abs), 1 => Just(-0.0)]
}

fn any_scenario() -> impl Strategy<Value = Scenario> {
    let law = prop_oneof![
        any_finite().prop_map(|tension| TensionLaw::Constant(tension.abs().max(f64::from_bits(1)))),
        (prop::array::uniform3(any_finite()), prop::array::uniform3(any_finite()))
            .prop_map(|(horizontal, vertical)| TensionLaw::Hypot { horizontal, vertical }),
    ];
    let positive = || prop::option::of(any_finite().prop_map(|value| value.abs().max(f64::from_bits(1))));
    let strain = prop::option::of(prop_oneof![Just(Strain::Green), Just(Strain::Engineering)]);
    let own =
        (positive(), positive(), positive(), strain).prop_map(|(youngs_modulus, area, mass_per_length, strain)| {
            OwnMaterial { youngs_modulus, area, mass_per_length, strain }
        });
    // Products of the own values often leave the range of numbers, so most cables have none.
    let own = prop_oneof![5 => Just(OwnMaterial::default()), 1 => own];
    let cable = (prop::array::uniform2(any_finite()), law, own).prop_map(|(anchor, tension, cable)| Cable {
        anchor,
        tension,
        cable,
    });
    let cables = (prop::collection::vec(cable, 3..=8), any::<(prop::sample::Index, prop::sample::Index)>()).prop_map(
        |(mut cables, (a, b))| {
            let (a, b) = (a.index(cables.len()), b.index(cables.len() - 1));
            for i in [a, if b < a { b } else { b + 1 }] {
                cables[i].tension = TensionLaw::Equilibrium;
            }
            cables
        },
    );
    let material = (prop::array::uniform3(any_finite().prop_map(f64::abs)), any::<bool>());
    let path = {
        let coordinate = prop_oneof![5 => -1e3_f64..1e3, 1 => any_finite()];
        let points = prop::collection::vec(prop::array::uniform2(coordinate), 1..4);
        let duration = (1e-3_f64..1e3, not_negative(), 0..4_u8, any::<bool>());
        (points, duration).prop_map(|(points, (speed, other, profile, smooth))| Path {
            points,
            corners: if smooth { Corners::Smooth } else { Corners::Stop },
            profile: [ProfileKind::Quintic, ProfileKind::Trapezoid, ProfileKind::Scurve, ProfileKind::Constant]
                [usize::from(profile)],
            speed,
            acceleration: other.max(f64::from_bits(1)),
            jerk: 0.1 / speed,
            hold: if profile == 3 { -0.0 } else { 1.0 / 3.0 },
        })
    };
    let name =
        prop_oneof![Just(None), any::<String>().prop_map(Some), Just(Some("Seil\u{ad}roboter 绳索 🪢\0".to_owned()))];
    let motion = (prop::array::uniform2(any_finite()), prop::array::uniform2(any_finite()), not_negative());
    let rest = (not_negative(), any_finite(), prop::array::uniform2(not_negative()), 2..=200_usize, any::<bool>());
    let motion = (motion, prop::option::of(path));
    (name, material, cables, motion, rest).prop_filter_map("not physical", |(name, material, cables, motion, rest)| {
        let ([youngs_modulus, area, mass_per_length], engineering) = material;
        let (gravity, mass, [alpha, beta], elements_per_cable, tangent) = rest;
        let ((position, direction, speed), path) = motion;
        let scenario = Scenario {
            name,
            gravity,
            cable: Material {
                youngs_modulus,
                area,
                mass_per_length,
                strain: if engineering { Strain::Engineering } else { Strain::Green },
            },
            platform: Platform { mass: mass.abs() },
            cables,
            elements_per_cable,
            damping: Damping { alpha, beta },
            linearisation: if tangent { Linearisation::Tangent } else { Linearisation::Secant },
            motion: Motion {
                position: if path.is_some() { position.map(f64::sin) } else { position },
                direction,
                speed,
            },
            path,
        };
        // A path from anywhere mostly takes too long; without one the robot is there as well.
        let scenario = if scenario.to_robot().is_ok() { scenario } else { Scenario { path: None, ..scenario } };
        scenario.to_robot().is_ok().then_some(scenario)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nothing_is_lost(scenario in any_scenario()) {
        let again = link::decode(&link::encode(&scenario));
        prop_assert_eq!(again.as_ref(), Ok(&scenario));
        // Zeros of both signs are equal, their texts are not.
        prop_assert_eq!(again.unwrap().to_json(), scenario.to_json());
    }

    #[test]
    fn garbage_is_told(text in any::<String>(), more in "1[A-Za-z0-9_-]{0,200}", bytes in any::<Vec<u8>>()) {
        for garbage in [text, more] {
            prop_assert!(matches!(link::decode(&garbage), Err(LinkError::Damaged | LinkError::Newer)), "{}", garbage);
        }
        // With a right checksum too, any bytes are told or survive.
        for link in [around(&bytes), around_second(&bytes), around_third(&bytes)] {
            if let Ok(scenario) = link::decode(&link) {
                prop_assert_eq!(link::decode(&link::encode(&scenario)), Ok(scenario));
            }
        }
    }

    #[test]
    fn changed_bytes_are_told_or_survive(at in any::<prop::sample::Index>(), byte in any::<u8>()) {
        let own: [&[u8]; 4] = [&[1, 0x27, 8], &[0], &[22, 0x30, 0x24], &[8]];
        let second: Vec<Vec<u8>> = CABLES.iter().zip(own).map(|(cable, own)| [cable, own].concat()).collect();
        let second: Vec<&[u8]> = second.iter().map(Vec::as_slice).collect();
        let path = [&with_cables(&[4], &second)[..], &[6, 2, 0x65, 0x14, 0xec, 0x01, 0x1d, 0x45, 0x35, 0x85, 0x01, 0x05]];
        for (mark, mut bytes) in
            [("1", with_cables(&[4], &CABLES)), ("2", with_cables(&[4], &second)), ("3", path.concat())]
        {
            let at = at.index(bytes.len());
            bytes[at] = byte;
            match link::decode(&of_version(mark, &bytes)) {
                Ok(scenario) => prop_assert_eq!(link::decode(&link::encode(&scenario)), Ok(scenario)),
                Err(error) => prop_assert!(!error.to_string().is_empty() && error != LinkError::Newer),
            }
        }
    }
}
