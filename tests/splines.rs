//! Paths and trajectories against numbers that are not the crate's: splines and arc lengths by scipy's `CubicSpline` (natural
//! and clamped ends) with adaptive quadrature and root finding.

use tautline::robot::{PathPoint, Profile, Side, Trajectory, Vec2};

/// Both programs find places on the curve by root finding in double precision; curvatures follow with a few digits less.
const TOLERANCE: f64 = 1e-9;

fn points(list: &[[f64; 2]]) -> Vec<Vec2> {
    list.iter().copied().map(Vec2::from).collect()
}

fn smooth(list: &[[f64; 2]]) -> Option<Trajectory> {
    Trajectory::smooth(list[0].into(), &points(&list[1..]), Profile::Quintic { speed: 2.0 })
}

fn assert_near(found: Vec2, expected: [f64; 2], what: &str) {
    assert!((found - Vec2::from(expected)).norm() < TOLERANCE, "{what}: {found:?}, not {expected:?}");
}

/// Length, and at parts of it position, tangent and curvature.
type Curve<'a> = (&'a [[f64; 2]], f64, [(f64, [f64; 6]); 3]);

const PLAIN: Curve = (
    &[[-6.0, 0.0], [-2.0, 2.5], [1.0, -1.0], [6.0, 0.5]],
    15.085_448_204_419_967,
    [
        (
            0.13,
            [
                -4.602_762_545_268_878,
                1.375_654_284_603_022_4,
                0.741_616_203_677_110_7,
                0.670_824_422_962_931_7,
                0.048_612_530_244_822_36,
                -0.053_742_587_325_709_28,
            ],
        ),
        (
            0.5,
            [
                -0.329_877_331_350_218_6,
                0.547_925_059_680_845_6,
                0.546_042_664_624_002_9,
                -0.837_757_368_460_772_6,
                0.024_465_012_701_006_68,
                0.015_946_073_682_243_336,
            ],
        ),
        (
            0.81,
            [
                3.512_297_869_800_853_3,
                -0.917_556_132_594_759_9,
                0.918_451_217_990_536,
                0.395_534_271_804_228_34,
                -0.055_905_717_738_848_566,
                0.129_815_993_733_394_75,
            ],
        ),
    ],
);

/// The first chord is 400 times shorter than the second.
const UNEVEN: Curve = (
    &[[0.0, 0.0], [0.01, 0.02], [8.0, 1.0], [8.3, -4.0]],
    14.161_112_626_802_93,
    [
        (
            0.13,
            [
                1.275_643_767_316_152_5,
                1.291_170_597_480_54,
                0.861_830_343_007_934_9,
                0.507_196_667_842_785_7,
                0.112_404_153_921_257_69,
                -0.190_997_529_501_715_4,
            ],
        ),
        (
            0.5,
            [
                6.358_030_481_107_162,
                1.905_392_759_031_455_9,
                0.965_477_375_450_125_5,
                -0.260_486_923_844_437_3,
                -0.049_154_590_804_467_595,
                -0.182_188_205_921_476_36,
            ],
        ),
        (
            0.81,
            [
                8.659_933_448_785_013,
                -1.336_187_500_158_484,
                -0.029_359_983_612_077_93,
                -0.999_568_902_758_733_4,
                -0.136_187_447_867_255_7,
                0.004_000_185_706_575_975_5,
            ],
        ),
    ],
);

/// Two turns so sharp that the parameter's speed falls to a hundredth.
const SHARP: Curve = (
    &[[0.0, 0.0], [5.0, 0.1], [0.2, 0.6], [4.0, 3.0]],
    14.760_468_514_360_603,
    [
        (
            0.13,
            [
                1.918_596_378_131_405,
                0.031_860_225_056_020_98,
                0.999_857_905_117_312_7,
                0.016_857_329_990_807_524,
                -7.334_084_989_593_924e-6,
                0.000_435_006_187_672_804_64,
            ],
        ),
        (
            0.5,
            [
                2.772_358_438_336_269,
                0.149_408_018_200_719_47,
                -0.998_764_482_605_160_4,
                0.049_694_147_406_372_78,
                0.001_712_942_724_692_019_8,
                0.034_427_119_559_352_77,
            ],
        ),
        (
            0.81,
            [
                1.456_261_184_650_204_7,
                1.820_099_645_046_431,
                0.887_629_347_738_775_2,
                0.460_558_509_890_802_55,
                0.029_649_909_585_731_96,
                -0.057_143_944_452_002_17,
            ],
        ),
    ],
);

#[test]
fn smooth_paths_are_natural_splines_by_chord_length_and_arc_length() {
    for (through, length, places) in [PLAIN, UNEVEN, SHARP] {
        let trajectory = smooth(through).expect("a path");
        assert!((trajectory.length() - length).abs() < TOLERANCE, "{} {length}", trajectory.length());
        for (part, [x, y, tx, ty, kx, ky]) in places {
            let PathPoint { position, tangent, curvature } = trajectory.point(part * length, Side::Right);
            assert_near(position, [x, y], "position");
            assert_near(tangent, [tx, ty], "tangent");
            assert_near(curvature, [kx, ky], "curvature");
        }
        // Ends are natural: straight.
        for s in [0.0, length] {
            assert!(trajectory.point(s, Side::Left).curvature.norm() < 1e-12, "{s}");
        }
        // One profile over the whole length.
        assert!((trajectory.duration() - 15.0 * length / 16.0).abs() < TOLERANCE);
        assert!(trajectory.corners().is_empty() && trajectory.breaks().is_empty());
    }
}

/// The way back is the same curve, and three points in a line give a line.
#[test]
fn smooth_paths_have_the_symmetries_of_their_points() {
    let (through, length, _) = PLAIN;
    let back: Vec<[f64; 2]> = through.iter().rev().copied().collect();
    let (there, back) = (smooth(through).expect("a path"), smooth(&back).expect("a path"));
    for part in [0.0, 0.2, 0.5, 0.9, 1.0] {
        let a = there.point(part * length, Side::Right);
        let b = back.point((1.0 - part) * length, Side::Right);
        let off =
            (a.position - b.position).norm() + (a.tangent + b.tangent).norm() + (a.curvature - b.curvature).norm();
        assert!(off < TOLERANCE, "{part}: {a:?} {b:?}");
    }
    let line = smooth(&[[-3.0, 1.0], [1.0, 3.0], [2.0, 3.5]]).expect("a path");
    assert!((line.length() - 5.0 * 1.25_f64.sqrt()).abs() < 1e-14);
    for s in [0.0, 1.3, 4.4, 5.0] {
        let point = line.point(s, Side::Right);
        assert_near(point.position, [-3.0 + s / 1.25_f64.sqrt(), 1.0 + 0.5 * s / 1.25_f64.sqrt()], "on the line");
        assert!(point.curvature.norm() < 1e-14);
    }
    assert_eq!(smooth(&[[0.0, 0.0], [4.0, 0.0], [1.0, 0.0]]), None, "it would turn back");
}

/// Position, velocity and acceleration at times, with the arc length until then.
#[test]
fn trajectories_are_splines_in_time_at_rest_at_both_ends() {
    let through = points(&[[-6.0, 0.0], [-2.0, 2.5], [1.0, -1.0], [1.0, -1.5], [6.0, 0.5]]);
    // A first time that is not 0 is where it begins.
    for first in [0.0, 12.5] {
        let times = [0.0, 1.0, 2.5, 3.5, 6.0].map(|time| time + first);
        let trajectory = Trajectory::timed(&times, &through).expect("a trajectory");
        assert!((trajectory.length() - 16.387_485_062_191_25).abs() < TOLERANCE, "{}", trajectory.length());
        assert!(
            (trajectory.duration() - 6.0).abs() < 1e-12
                && trajectory.is_rest_to_rest()
                && trajectory.breaks().is_empty()
        );
        for (time, s, [x, y, vx, vy, ax, ay]) in [
            (0.0, 0.0, [-6.0, 0.0, 0.0, 0.0, 14.391_959_798_994_975, 12.379_731_993_299_831]),
            (
                0.4,
                1.210_665_810_887_318_7,
                [
                    -5.053_185_929_648_241,
                    0.754_227_135_678_392_1,
                    4.222_713_567_839_196,
                    3.180_757_118_927_972_6,
                    6.721_608_040_201_005,
                    3.524_053_601_340_033,
                ],
            ),
            (
                2.2,
                9.271_988_974_766_694,
                [
                    0.922_452_261_306_532_9,
                    -0.131_384_924_623_117_35,
                    0.568_442_211_055_276_5,
                    -3.343_051_926_298_157_3,
                    -2.275_376_884_422_110_7,
                    2.004_154_103_852_597_4,
                ],
            ),
            (
                3.5,
                10.995_377_366_410_686,
                [
                    1.0,
                    -1.5,
                    0.864_321_608_040_201,
                    0.628_810_720_268_006_8,
                    3.417_085_427_135_678_5,
                    0.913_902_847_571_189_2,
                ],
            ),
            (6.0, 16.387_485_062_191_25, [6.0, 0.5, 0.0, 0.0, -4.108_542_713_567_841, -1.416_951_423_785_595]),
        ] {
            let moment = trajectory.at(time, Side::Left);
            assert!((moment.s - s).abs() < TOLERANCE, "{time}: {} {s}", moment.s);
            assert_near(moment.point.position, [x, y], "position");
            assert_near(moment.velocity(), [vx, vy], "velocity");
            assert_near(moment.acceleration(), [ax, ay], "acceleration");
            assert!((moment.v - vx.hypot(vy)).abs() < TOLERANCE && moment.v >= 0.0, "{moment:?}");
        }
    }
}

/// There and back along one line: in between the platform rests for a moment, and turns. s goes on, and p̈ is that of the
/// spline from both sides.
#[test]
fn a_trajectory_may_turn_back() {
    let through = points(&[[0.0, 0.0], [3.0, 1.5], [0.0, 0.0]]);
    let trajectory = Trajectory::timed(&[0.0, 1.0, 2.0], &through).expect("a trajectory");
    let way = 3.0_f64.hypot(1.5);
    assert!((trajectory.length() - 2.0 * way).abs() < TOLERANCE);
    for side in [Side::Left, Side::Right] {
        let moment = trajectory.at(1.0, side);
        assert!((moment.s - way).abs() < TOLERANCE && moment.v < TOLERANCE, "{moment:?}");
        assert_near(moment.acceleration(), [-18.0, -9.0], "acceleration");
        assert_near(moment.point.position, [3.0, 1.5], "position");
        // It comes with a tangent away from the beginning, and braking; it leaves towards it, speeding up.
        let sign = if side == Side::Left { 1.0 } else { -1.0 };
        assert_near(moment.point.tangent, [sign * 3.0 / way, sign * 1.5 / way], "tangent");
        assert!(moment.a * sign < 0.0, "{moment:?}");
    }
    for (time, back) in [(0.9, 1.1), (0.999_999, 1.000_001)] {
        let [a, b] = [time, back].map(|time| trajectory.at(time, Side::Right));
        assert_near(a.velocity(), (-b.velocity()).into(), "velocity");
        assert_near(a.acceleration(), b.acceleration().into(), "acceleration");
    }
}
