//! The small pictures on the cards of words: pure geometry. A picture has its own frame, x to the right and y down.

use std::f32::consts::TAU;

use super::word::Word;

/// The size of every picture, in points.
pub const SIZE: [f32; 2] = [220.0, 90.0];

/// A point in the frame of a picture.
pub type Point = [f32; 2];

/// What a mark stands for, and so which of the interface's colours it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// Axes and what stays in the background.
    Frame,
    /// Words without a colour of their own.
    Weak,
    /// What the picture is about.
    Accent,
    /// What dies out.
    Stable,
    /// What grows.
    Critical,
    /// Waves and their limit.
    Waves,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// As an axis.
    Thin,
    /// As what matters.
    Solid,
    /// In dashes.
    Dashed,
}

/// A part of a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum PicturePart {
    /// A line through points.
    Line(Vec<Point>, Form, Ink),
    /// An arrow.
    Arrow([Point; 2], Ink),
    /// A disc.
    Dot(Point, f32, Ink),
    /// A filled box between two corners.
    Bar([Point; 2], Ink),
    /// A text whose middle line is at the point's height. It begins there, or lies around it by this part of its width.
    Text(Point, f32, &'static str, Ink),
}

/// Where a text lies: it begins at its point, has its middle there, or ends there.
const BEGINS: f32 = 0.0;
/// See [`BEGINS`].
const MIDDLE: f32 = 0.5;
/// See [`BEGINS`].
const ENDS: f32 = 1.0;

/// The ends of drawings from left to right.
const LEFT: f32 = 12.0;
/// See [`LEFT`].
const RIGHT: f32 = 208.0;
/// Half the size of a winch.
const WINCH: f32 = 4.0;

/// The picture of a word.
pub fn of(word: Word) -> Vec<PicturePart> {
    match word {
        Word::CriticalSpeed => critical_speed(),
        Word::FrozenTime => frozen_time(),
        Word::WaveLimit => wave_limit(),
        Word::WaveRatio => wave_ratio(),
        Word::Gain => gain(),
        Word::Path => path(),
        Word::MotionProfile => motion_profile(),
        Word::Flutter => over_time(|t| -3.0 * (2.2 * t).exp() * (5.0 * TAU * t).sin(), Ink::Critical),
        Word::Divergence => over_time(|t| -2.5 * (2.55 * t).exp(), Ink::Critical),
        Word::GrowthRate => growth_rate(),
        Word::DampingRatio => damping_ratio(),
        Word::ModeShape => mode_shape(),
        Word::Stiffness => stiffness(),
        Word::Strain => strain(),
        Word::Holding => holding(),
        Word::UnstretchedLength => unstretched_length(),
        Word::Reeling => reeling(),
        Word::Slack => slack(),
        Word::Campbell => campbell(),
        Word::MeshError => mesh_error(),
        Word::Sensitivity => sensitivity(),
    }
}

/// A smooth curve: the points of `at` for 0 … 1.
fn curve(at: impl Fn(f32) -> Point) -> Vec<Point> {
    const PIECES: u8 = 96;
    (0..=PIECES).map(|i| at(f32::from(i) / f32::from(PIECES))).collect()
}

fn line(points: impl Into<Vec<Point>>, ink: Ink) -> PicturePart {
    PicturePart::Line(points.into(), Form::Solid, ink)
}

fn dashed(points: impl Into<Vec<Point>>, ink: Ink) -> PicturePart {
    PicturePart::Line(points.into(), Form::Dashed, ink)
}

fn thin(points: impl Into<Vec<Point>>) -> PicturePart {
    PicturePart::Line(points.into(), Form::Thin, Ink::Frame)
}

fn winch([x, y]: Point) -> PicturePart {
    PicturePart::Bar([[x - WINCH, y - WINCH], [x + WINCH, y + WINCH]], Ink::Weak)
}

/// A displacement over time, in points downward from the middle line, for 0 … 1.
fn over_time(displacement: impl Fn(f32) -> f32, ink: Ink) -> Vec<PicturePart> {
    let middle = 44.0;
    vec![
        thin([[LEFT, middle], [RIGHT, middle]]),
        line(curve(|t| [LEFT + t * (RIGHT - LEFT), middle + displacement(t)]), ink),
        PicturePart::Text([RIGHT, 82.0], ENDS, "time", Ink::Weak),
    ]
}

fn critical_speed() -> Vec<PicturePart> {
    let zero = 42.0;
    let growth = |t: f32| [LEFT + 190.0 * t, 66.0 - 48.0 * t * t];
    // Where 66 − 48 t² is the zero line.
    let crossing = growth(0.5_f32.sqrt());
    vec![
        thin([[LEFT, zero], [RIGHT, zero]]),
        PicturePart::Text([LEFT, 52.0], BEGINS, "dies out", Ink::Stable),
        PicturePart::Text([LEFT, 30.0], BEGINS, "grows", Ink::Critical),
        line(curve(|t| growth(t * 0.5_f32.sqrt())), Ink::Stable),
        line(curve(|t| growth(0.5_f32.sqrt() + t * (1.0 - 0.5_f32.sqrt()))), Ink::Critical),
        dashed([crossing, [crossing[0], 74.0]], Ink::Critical),
        PicturePart::Dot(crossing, 4.5, Ink::Critical),
        PicturePart::Text([crossing[0] - 6.0, 81.0], MIDDLE, "critical", Ink::Critical),
        PicturePart::Text([RIGHT, 81.0], ENDS, "speed", Ink::Weak),
    ]
}

fn frozen_time() -> Vec<PicturePart> {
    let mut marks = Vec::new();
    for (y, end, ink) in [(16.0, 190.0, Ink::Frame), (44.0, 150.0, Ink::Accent), (72.0, 110.0, Ink::Frame)] {
        marks.extend([winch([24.0, y]), line([[28.0, y], [end, y]], ink), PicturePart::Dot([end, y], 5.0, ink)]);
    }
    let (low, high) = ([12.0, 31.0], [164.0, 57.0]);
    marks.push(dashed([low, [high[0], low[1]], high, [low[0], high[1]], low], Ink::Accent));
    marks.push(PicturePart::Text([RIGHT, 44.0], ENDS, "now", Ink::Accent));
    marks.push(PicturePart::Text([RIGHT, 72.0], ENDS, "later", Ink::Weak));
    marks
}

fn wave_limit() -> Vec<PicturePart> {
    let y = 45.0;
    let wave = |t: f32| [76.0 + 72.0 * t, y - 9.0 * (TAU * t).sin() * (0.5 * TAU * t).sin()];
    vec![
        PicturePart::Dot([20.0, y], 6.0, Ink::Accent),
        line([[26.0, y], [76.0, y]], Ink::Accent),
        line(curve(wave), Ink::Accent),
        line([[148.0, y], [196.0, y]], Ink::Accent),
        winch([200.0, y]),
        PicturePart::Arrow([[148.0, 23.0], [76.0, 23.0]], Ink::Waves),
        PicturePart::Text([112.0, 11.0], MIDDLE, "waves run", Ink::Waves),
        PicturePart::Arrow([[76.0, 66.0], [148.0, 66.0]], Ink::Accent),
        PicturePart::Text([112.0, 80.0], MIDDLE, "the winch reels", Ink::Accent),
    ]
}

fn wave_ratio() -> Vec<PicturePart> {
    let (bottom, limit) = (72.0, |t: f32| 22.0 + 14.0 * (2.0 * t - 1.0).powi(2));
    let across = |t: f32| LEFT + (RIGHT - LEFT) * t;
    // The speed of a quintic: 16 t² (1 − t)² of its peak.
    let flown = |t: f32| bottom - 33.0 * 16.0 * t * t * (1.0 - t) * (1.0 - t);
    vec![
        dashed(curve(|t| [across(t), limit(t)]), Ink::Waves),
        line(curve(|t| [across(t), flown(t)]), Ink::Accent),
        thin([[LEFT, bottom], [RIGHT, bottom]]),
        PicturePart::Arrow([[across(0.5), bottom], [across(0.5), limit(0.5)]], Ink::Weak),
        PicturePart::Text([LEFT + 38.0, 14.0], MIDDLE, "wave limit", Ink::Waves),
        PicturePart::Text([across(0.5), 82.0], MIDDLE, "speed along the path", Ink::Accent),
    ]
}

fn path() -> Vec<PicturePart> {
    let at = |t: f32| [40.0 + 140.0 * t, 44.0 - 18.0 * (TAU * t).sin()];
    let mut parts = vec![line(curve(at), Ink::Accent)];
    // Equal times of a quintic.
    for i in 1..8_u8 {
        let time = f32::from(i) / 8.0;
        let [x, y] = at(time.powi(3) * (10.0 - 15.0 * time + 6.0 * time * time));
        parts.push(thin([[x, y - 5.0], [x, y + 5.0]]));
    }
    parts.push(PicturePart::Dot(at(0.0), 5.0, Ink::Accent));
    parts.push(PicturePart::Dot(at(1.0), 5.0, Ink::Accent));
    parts.push(PicturePart::Text([40.0, 62.0], MIDDLE, "start", Ink::Weak));
    parts.push(PicturePart::Text([180.0, 62.0], MIDDLE, "stop", Ink::Weak));
    parts
}

/// The speeds of the three profiles from rest to rest over time, one beside the other.
fn motion_profile() -> Vec<PicturePart> {
    let (bottom, top, width) = (66.0, 22.0, 56.0);
    let quintic = |t: f32| 16.0 * t * t * (1.0 - t) * (1.0 - t);
    let trapezoid = |t: f32| (t.min(1.0 - t) / 0.3).min(1.0);
    let s_curve = move |t: f32| {
        let rise = (t.min(1.0 - t) / 0.4).min(1.0);
        if rise < 0.5 { 2.0 * rise * rise } else { 1.0 - 2.0 * (1.0 - rise) * (1.0 - rise) }
    };
    let profiles: [(&'static str, &dyn Fn(f32) -> f32); 3] =
        [("quintic", &quintic), ("trapezoid", &trapezoid), ("S-curve", &s_curve)];
    let mut parts = Vec::new();
    for ((name, speed), left) in profiles.into_iter().zip([LEFT, 82.0, 152.0]) {
        parts.push(thin([[left, bottom], [left + width, bottom]]));
        parts.push(line(curve(|t| [left + width * t, bottom - (bottom - top) * speed(t)]), Ink::Accent));
        parts.push(PicturePart::Text([left + 0.5 * width, 79.0], MIDDLE, name, Ink::Weak));
    }
    parts.push(PicturePart::Text([LEFT, 10.0], BEGINS, "speed", Ink::Weak));
    parts
}

fn gain() -> Vec<PicturePart> {
    let y = 38.0;
    let wave = |from: f32, size: f32| curve(move |t| [from + 62.0 * t, y - size * (2.0 * TAU * t).sin()]);
    vec![
        line(wave(LEFT + 8.0, 13.0), Ink::Accent),
        line(wave(RIGHT - 62.0, 26.0), Ink::Critical),
        thin([[LEFT, y - 13.0], [LEFT, y + 13.0]]),
        thin([[RIGHT - 70.0, y - 26.0], [RIGHT - 70.0, y + 26.0]]),
        PicturePart::Arrow([[92.0, y], [128.0, y]], Ink::Weak),
        PicturePart::Text([LEFT + 38.0, 80.0], MIDDLE, "before", Ink::Accent),
        PicturePart::Text([110.0, 24.0], MIDDLE, "move", Ink::Weak),
        PicturePart::Text([RIGHT - 32.0, 80.0], MIDDLE, "after", Ink::Critical),
    ]
}

fn growth_rate() -> Vec<PicturePart> {
    let y = 38.0;
    let swing = |from: f32, size: fn(f32) -> f32| {
        let at = move |t: f32| [from + 92.0 * t, y - size(t) * (4.0 * TAU * t).cos()];
        let envelope = move |t: f32| [from + 92.0 * t, y - size(t)];
        (curve(at), curve(envelope))
    };
    let (falling, its_bound) = swing(LEFT, |t| 28.0 * (-2.0 * t).exp());
    let (rising, her_bound) = swing(116.0, |t| 28.0 * (2.0 * t - 2.0).exp());
    vec![
        line(falling, Ink::Stable),
        dashed(its_bound, Ink::Stable),
        line(rising, Ink::Critical),
        dashed(her_bound, Ink::Critical),
        PicturePart::Text([58.0, 80.0], MIDDLE, "below 0", Ink::Stable),
        PicturePart::Text([162.0, 80.0], MIDDLE, "above 0", Ink::Critical),
    ]
}

/// A swing that is let go, for damping ratios below 1 and at 1. Time runs to four swings without damping.
fn let_go(zeta: f32, t: f32) -> f32 {
    let phase = 4.0 * TAU * t;
    if zeta < 1.0 {
        let slower = (1.0 - zeta * zeta).sqrt();
        (-zeta * phase).exp() * ((slower * phase).cos() + zeta / slower * (slower * phase).sin())
    } else {
        (-phase).exp() * (1.0 + phase)
    }
}

fn damping_ratio() -> Vec<PicturePart> {
    let y = 38.0;
    let cases = [(LEFT, 0.02, "2 %"), (80.0, 0.2, "20 %"), (148.0, 1.0, "100 %")];
    let draw = |(from, zeta, name): (f32, f32, &'static str)| {
        [
            thin([[from, y], [from + 60.0, y]]),
            line(curve(|t| [from + 60.0 * t, y - 28.0 * let_go(zeta, t)]), Ink::Accent),
            PicturePart::Text([from + 30.0, 80.0], MIDDLE, name, Ink::Weak),
        ]
    };
    cases.into_iter().flat_map(draw).collect()
}

fn mode_shape() -> Vec<PicturePart> {
    let (from, to) = ([20.0, 20.0], [200.0, 50.0]);
    // A cable that sags, and its second mode, out and back.
    let at = |t: f32, out: f32| {
        let rest = from[1] + (to[1] - from[1]) * t + 60.0 * t * (1.0 - t);
        [from[0] + (to[0] - from[0]) * t, rest + out * (TAU * t).sin()]
    };
    vec![
        thin(curve(|t| at(t, 0.0))),
        line(curve(|t| at(t, 18.0)), Ink::Accent),
        dashed(curve(|t| at(t, -18.0)), Ink::Accent),
        winch(from),
        winch(to),
    ]
}

fn stiffness() -> Vec<PicturePart> {
    let y = 40.0;
    let draw = |x: f32, along: f32, name: &'static str| {
        [
            line([[x - 44.0, y], [x + 44.0, y]], Ink::Frame),
            PicturePart::Arrow([[x, y], [x, y - 28.0]], Ink::Accent),
            PicturePart::Arrow([[x, y], [x + along, y]], Ink::Accent),
            PicturePart::Dot([x, y], 4.0, Ink::Accent),
            PicturePart::Text([x, 60.0], MIDDLE, name, Ink::Weak),
        ]
    };
    let mut marks: Vec<PicturePart> =
        draw(58.0, 28.0, "secant").into_iter().chain(draw(162.0, 7.0, "tangent")).collect();
    marks.push(PicturePart::Text([110.0, 80.0], MIDDLE, "how far equal forces move it", Ink::Accent));
    marks
}

fn strain() -> Vec<PicturePart> {
    // Forces over EA for stretches λ from 1 to 1.5; 15/16 is Green's at the end.
    let at = |t: f32, force: fn(f32) -> f32| [LEFT + 130.0 * t, 74.0 - 64.0 * force(1.0 + 0.5 * t) / 0.9375];
    vec![
        thin([[LEFT, 8.0], [LEFT, 74.0], [160.0, 74.0]]),
        line(curve(|t| at(t, |stretch| 0.5 * (stretch * stretch * stretch - stretch))), Ink::Accent),
        line(curve(|t| at(t, |stretch| stretch - 1.0)), Ink::Waves),
        PicturePart::Text([148.0, 12.0], BEGINS, "Green's", Ink::Accent),
        PicturePart::Text([146.0, 44.0], BEGINS, "engineering", Ink::Waves),
        PicturePart::Text([18.0, 12.0], BEGINS, "force", Ink::Weak),
        PicturePart::Text([RIGHT, 80.0], ENDS, "stretch", Ink::Weak),
    ]
}

fn holding() -> Vec<PicturePart> {
    let platform = [76.0, 44.0];
    let corners = [[16.0, 10.0], [136.0, 10.0], [16.0, 80.0], [136.0, 80.0]];
    let mut marks = Vec::new();
    for (i, corner) in corners.into_iter().enumerate() {
        let cable = [platform, corner];
        marks.push(if i < 2 { line(cable, Ink::Accent) } else { dashed(cable, Ink::Waves) });
        marks.push(winch(corner));
    }
    marks.push(PicturePart::Dot(platform, 6.0, Ink::Accent));
    marks.push(PicturePart::Text([RIGHT, 26.0], ENDS, "holding", Ink::Accent));
    marks.push(PicturePart::Text([RIGHT, 66.0], ENDS, "stiffening", Ink::Waves));
    marks
}

fn unstretched_length() -> Vec<PicturePart> {
    let ends = |x: f32, y: f32| thin([[x, y - 8.0], [x, y + 8.0]]);
    vec![
        line([[20.0, 22.0], [130.0, 22.0]], Ink::Accent),
        ends(20.0, 22.0),
        ends(130.0, 22.0),
        PicturePart::Text([142.0, 22.0], BEGINS, "L, no force", Ink::Accent),
        line([[20.0, 62.0], [154.0, 62.0]], Ink::Waves),
        ends(20.0, 62.0),
        ends(154.0, 62.0),
        PicturePart::Arrow([[158.0, 62.0], [192.0, 62.0]], Ink::Weak),
        PicturePart::Text([87.0, 80.0], MIDDLE, "stretched by a force", Ink::Waves),
    ]
}

fn reeling() -> Vec<PicturePart> {
    let y = 38.0;
    vec![
        winch([20.0, y]),
        line([[24.0, y], [104.0, y]], Ink::Accent),
        line([[116.0, y], [196.0, y]], Ink::Accent),
        winch([200.0, y]),
        PicturePart::Dot([110.0, y], 6.0, Ink::Accent),
        PicturePart::Arrow([[110.0, 18.0], [146.0, 18.0]], Ink::Accent),
        PicturePart::Arrow([[36.0, 58.0], [76.0, 58.0]], Ink::Weak),
        PicturePart::Text([56.0, 76.0], MIDDLE, "paid out", Ink::Weak),
        PicturePart::Arrow([[144.0, 58.0], [184.0, 58.0]], Ink::Weak),
        PicturePart::Text([164.0, 76.0], MIDDLE, "reeled in", Ink::Weak),
    ]
}

fn slack() -> Vec<PicturePart> {
    let (winch_at, platform) = ([20.0, 14.0], [150.0, 34.0]);
    let straight = |t: f32| winch_at[1] + (platform[1] - winch_at[1]) * t;
    let across = |t: f32| winch_at[0] + (platform[0] - winch_at[0]) * t;
    vec![
        line([winch_at, platform], Ink::Accent),
        dashed(curve(|t| [across(t), straight(t) + 200.0 * t * (1.0 - t)]), Ink::Critical),
        winch(winch_at),
        PicturePart::Dot(platform, 6.0, Ink::Accent),
        PicturePart::Text([RIGHT, 14.0], ENDS, "taut: pulls", Ink::Accent),
        PicturePart::Text([RIGHT, 66.0], ENDS, "slack", Ink::Critical),
    ]
}

fn campbell() -> Vec<PicturePart> {
    let mode = |from: f32, fall: f32| move |t: f32| [LEFT + 190.0 * t, from + fall * t * t];
    let lowest = mode(48.0, 14.0);
    let crossing = lowest(0.65);
    vec![
        thin([[LEFT, 8.0], [LEFT, 74.0], [RIGHT, 74.0]]),
        thin(curve(mode(20.0, 16.0))),
        thin(curve(mode(36.0, 8.0))),
        thin(curve(|t| lowest(0.65 * t))),
        line(curve(|t| lowest(0.65 + 0.35 * t)), Ink::Critical),
        PicturePart::Dot(crossing, 4.5, Ink::Critical),
        PicturePart::Text([18.0, 9.0], BEGINS, "Hz", Ink::Weak),
        PicturePart::Text([RIGHT - 8.0, 66.0], ENDS, "grows", Ink::Critical),
        PicturePart::Text([RIGHT, 82.0], ENDS, "speed", Ink::Weak),
    ]
}

fn mesh_error() -> Vec<PicturePart> {
    let at = |t: f32| [20.0 + 180.0 * t, 14.0 + 200.0 * t * (1.0 - t)];
    let nodes = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(at);
    let mut marks = vec![dashed(curve(at), Ink::Waves), line(nodes, Ink::Accent)];
    marks.extend(nodes.map(|node| PicturePart::Dot(node, 3.5, Ink::Accent)));
    marks.push(PicturePart::Text([110.0, 44.0], MIDDLE, "three pieces", Ink::Accent));
    marks.push(PicturePart::Text([110.0, 80.0], MIDDLE, "smooth cable", Ink::Waves));
    marks
}

fn sensitivity() -> Vec<PicturePart> {
    let zero: f32 = 110.0;
    let bar = |y: f32, length: f32| {
        let (from, to) = (zero.min(zero + length), zero.max(zero + length));
        let ink = if length > 0.0 { Ink::Accent } else { Ink::Critical };
        PicturePart::Bar([[from, y - 7.0], [to, y + 7.0]], ink)
    };
    vec![
        bar(14.0, 80.0),
        bar(35.0, -56.0),
        bar(56.0, 24.0),
        thin([[zero, 4.0], [zero, 68.0]]),
        PicturePart::Text([zero - 12.0, 80.0], ENDS, "lowers", Ink::Critical),
        PicturePart::Text([zero + 12.0, 80.0], BEGINS, "raises it", Ink::Accent),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The box around a mark. A caption's letters are 12 points high and at most 6.4 wide on average.
    fn bounds(mark: &PicturePart) -> [Point; 2] {
        let around = |points: &[Point], margin: f32| {
            let along = |i: usize| points.iter().map(move |point| point[i]);
            let low = [0, 1].map(|i| along(i).fold(f32::INFINITY, f32::min) - margin);
            let high = [0, 1].map(|i| along(i).fold(f32::NEG_INFINITY, f32::max) + margin);
            [low, high]
        };
        match mark {
            PicturePart::Line(points, ..) => around(points, 1.0),
            PicturePart::Arrow(points, _) => around(points, 4.0),
            PicturePart::Dot(at, radius, _) => around(&[*at], *radius),
            PicturePart::Bar(corners, _) => around(corners, 0.0),
            PicturePart::Text([x, y], part, text, _) => {
                let width = 6.4 * f32::from(u8::try_from(text.chars().count()).expect("short"));
                let left = x - part * width;
                [[left, y - 7.0], [left + width, y + 7.0]]
            }
        }
    }

    #[test]
    fn every_picture_stays_within_its_frame() {
        for word in Word::ALL {
            for mark in of(word) {
                let [low, high] = bounds(&mark);
                let inside = (0..2).all(|i| low[i] >= 0.0 && high[i] <= SIZE[i]);
                assert!(inside, "{word:?}: {low:?} to {high:?} of {mark:?}");
            }
        }
    }

    #[test]
    fn no_two_texts_of_a_picture_lie_on_each_other() {
        for word in Word::ALL {
            let texts: Vec<_> = of(word).into_iter().filter(|mark| matches!(mark, PicturePart::Text(..))).collect();
            for (i, one) in texts.iter().enumerate() {
                for other in &texts[..i] {
                    let ([low, high], [low2, high2]) = (bounds(one), bounds(other));
                    let apart = (0..2).any(|k| high[k] <= low2[k] || high2[k] <= low[k]);
                    assert!(apart, "{word:?}: {one:?} and {other:?}");
                }
            }
        }
    }

    #[test]
    fn every_word_has_a_picture_of_its_own() {
        for (i, word) in Word::ALL.into_iter().enumerate() {
            let picture = of(word);
            assert!(picture.len() >= 3, "{word:?}");
            assert!(Word::ALL[..i].iter().all(|other| of(*other) != picture), "{word:?}");
        }
    }

    #[test]
    fn a_swing_that_is_let_go_begins_at_its_full_size_and_dies_out_as_its_damping_says() {
        for zeta in [0.02, 0.2, 1.0] {
            assert!((let_go(zeta, 0.0) - 1.0).abs() < 1e-6);
        }
        // One swing of four: exp(−ζ ω T) with T a little longer than without damping.
        let after_one = let_go(0.02, 0.25 / (1.0_f32 - 0.0004).sqrt());
        assert!((after_one - (-0.02 * TAU / (1.0_f32 - 0.0004).sqrt()).exp()).abs() < 1e-4, "{after_one}");
    }
}
