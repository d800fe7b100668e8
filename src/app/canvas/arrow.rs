//! How long the arrow of the velocity is. Its scale goes in steps and follows the room that there is, so that its tip
//! can be grabbed at every speed, and the speeds marked on its line are on the canvas where that is possible.

use eframe::egui::{Pos2, Rect, Vec2};

use crate::app::round::round_step;

/// Points between the platform's middle and the arrow at rest, where there is room for them.
const GAP: f32 = 26.0;
/// Points between the tip and the canvas's border.
const BORDER: f32 = 12.0;
/// With less room than this, in points, an arrow cannot be seen; its tip may then leave the canvas.
const LEAST: f32 = 16.0;
/// A scale with longer arrows comes back where they need no more than this part of the room.
const COMFORTABLE: f32 = 0.7;
/// At the first scale an arrow of this many m/s is as long as the robot is wide.
const WHOLE: f64 = 40.0;
/// Marks at more than this many times the speed, or [`WHOLE`] where that is more, do not make the arrow shorter: its length
/// could not be set by hand any more.
const FARTHEST: f64 = 8.0;

/// How speeds are drawn as lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrow {
    /// So many m/s make a metre of the arrow.
    pub step: f64,
    /// Points between the platform's middle and the arrow at rest.
    gap: f32,
}

/// Where an arrow is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Ground {
    /// Points per metre of the world.
    pub scale: f64,
    /// Points from the platform's middle to where the tip may be at most.
    pub room: f32,
    /// How wide the robot is, in m.
    pub width: f64,
}

impl Arrow {
    /// The arrow of `speed`, with marks up to `farthest`, both in m/s. The step stays what it was `before` as long as that is
    /// sensible. While a pointer is `pressed`, it does so as long as the tip is on the canvas: an arrow that changes its
    /// length by itself would mislead whoever turns something.
    pub fn new(speed: f64, farthest: f64, ground: Ground, before: Option<f64>, pressed: bool) -> Self {
        let room = ground.room.max(LEAST);
        let gap = GAP.min(0.5 * room);
        let farthest = farthest.min((FARTHEST * speed).max(WHOLE)).max(speed);
        let fits = |step: f64, speed: f64, part: f32| {
            Self { step, gap }.away(speed, ground.scale) <= gap + part * (room - gap)
        };
        // About as long as the robot at the speed of WHOLE.
        let first = round_step(0.75 * WHOLE / ground.width);
        let smallest = |part| {
            let mut step = first;
            // Speeds are finite, so that this ends; 150 steps are 50 decades.
            for _ in 0..150 {
                if fits(step, farthest, part) {
                    break;
                }
                step = round_step(1.1 * step);
            }
            step
        };
        let needed = if pressed { speed } else { farthest };
        let kept = before.filter(|&step| step >= 0.99 * first && fits(step, needed, 1.0));
        let step = match kept {
            Some(step) if pressed => step,
            // Down only as far as is comfortable, so that it does not go to and fro about a limit.
            Some(step) => step.min(smallest(COMFORTABLE)),
            None => smallest(1.0),
        };
        Self { step, gap }
    }

    /// Points from the platform's middle to the tip. A metre of the world is `scale` points.
    pub fn away(&self, speed: f64, scale: f64) -> f32 {
        #[expect(clippy::cast_possible_truncation)] // Screen coordinates are f32.
        let length = (speed * scale / self.step) as f32;
        self.gap + length
    }

    /// The speed in m/s of an arrow whose tip is this number of points from the platform's middle, and the speed per point.
    pub fn speed(&self, away: f32, scale: f64) -> [f64; 2] {
        let point = self.step / scale;
        [f64::from((away - self.gap).max(0.0)) * point, point]
    }
}

/// The way in points from a place on the canvas to where a tip may be farthest in that direction. No limit where the
/// place itself is not on the canvas.
pub fn room(canvas: Rect, from: Pos2, direction: Vec2) -> f32 {
    if !canvas.contains(from) {
        return f32::INFINITY;
    }
    let within = canvas.shrink(BORDER);
    let along = |at: f32, way: f32, low: f32, high: f32| {
        if way > 1e-6 {
            (high - at) / way
        } else if way < -1e-6 {
            (low - at) / way
        } else {
            f32::INFINITY
        }
    };
    let x = along(from.x, direction.x, within.min.x, within.max.x);
    let y = along(from.y, direction.y, within.min.y, within.max.y);
    x.min(y).max(0.0)
}

#[cfg(test)]
mod tests {
    // Steps are chosen, not computed.
    #![expect(clippy::float_cmp)]

    use super::*;

    /// Points per metre of the paper's robot, 20 m wide, on a canvas of 320 × 296 points.
    const SCALE: f64 = 11.6;
    const WIDTH: f64 = 20.0;

    fn canvas() -> Rect {
        Rect::from_min_size(Pos2::new(0.0, 30.0), Vec2::new(320.0, 296.0))
    }

    fn ground(scale: f64, room: f32) -> Ground {
        Ground { scale, room, width: WIDTH }
    }

    #[test]
    fn the_tip_is_on_the_canvas_at_every_speed_everywhere() {
        for speed in [0.0, 1e-3, 1.0, 5.0, 25.0, 40.0, 299.0, 1e4, 1e9, 1e30] {
            for turn in 0..24_u8 {
                let direction = Vec2::angled(f32::from(turn) * 0.2618);
                for at in
                    [Pos2::new(160.0, 178.0), Pos2::new(44.0, 120.0), Pos2::new(276.0, 62.0), Pos2::new(300.0, 300.0)]
                {
                    for (scale, farthest) in [(SCALE, 0.0), (0.2 * SCALE, 11.3), (200.0 * SCALE, 1e9)] {
                        let ground = ground(scale, room(canvas(), at, direction));
                        let arrow = Arrow::new(speed, farthest, ground, None, false);
                        let tip = at + direction * arrow.away(speed, scale);
                        let what = format!("{speed} m/s, {at:?}, {direction:?}, {scale}: {tip:?}, {arrow:?}");
                        assert!(canvas().contains(tip), "{what}");
                        let [back, point] = arrow.speed(arrow.away(speed, scale), scale);
                        assert!((back - speed).abs() <= 1e-4 * speed + 1e-3 * point, "{what}: {back}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_scale_goes_in_round_steps_and_a_usual_speed_has_the_usual_one() {
        let step = |speed, room| Arrow::new(speed, 0.0, ground(25.0, room), None, false).step;
        assert_eq!([step(5.0, 250.0), step(25.0, 250.0), step(60.0, 250.0)], [2.0, 5.0, 10.0]);
        // The least scale is the robot's, not that of the room.
        assert_eq!(step(0.0, 9e9), step(5.0, 9e9));
        let narrow = Ground { width: 3.6, ..ground(250.0, 250.0) };
        assert_eq!(Arrow::new(5.0, 0.0, narrow, None, false).step, 10.0);
    }

    /// 5 m/s with 11.9 m/s marked: at 2 m/s per metre the mark is 26 + 149 points away.
    #[test]
    fn there_is_room_for_the_marks_unless_they_are_far_off() {
        let step = |speed, farthest, room| Arrow::new(speed, farthest, ground(25.0, room), None, false).step;
        assert_eq!([step(5.0, 11.9, 180.0), step(5.0, 11.9, 170.0)], [2.0, 5.0]);
        // With 900 m/s in view 5 m/s would be a point.
        assert_eq!(step(5.0, 900.0, 300.0), step(5.0, 40.0, 300.0));
        assert_eq!(step(0.0, 900.0, 300.0), step(5.0, 40.0, 300.0));
    }

    #[test]
    fn a_step_is_kept_about_the_speed_where_it_changes() {
        let scale = 25.0;
        let steps = |speeds: &[f64]| {
            let mut step = None;
            let follow = |&speed: &f64| {
                step = Some(Arrow::new(speed, speed, ground(scale, 250.0), step, false).step);
                step
            };
            speeds.iter().filter_map(follow).collect::<Vec<f64>>()
        };
        // 17.92 m/s fill the room at 2 m/s per metre.
        assert_eq!(steps(&[17.0, 17.9, 18.0, 17.9, 17.0, 14.0, 12.0, 14.0]), [2.0, 2.0, 5.0, 5.0, 5.0, 5.0, 2.0, 2.0]);
        // A scale that belongs to another robot is given up.
        let narrow = Ground { width: 0.2, ..ground(scale, 250.0) };
        assert_eq!(Arrow::new(1.0, 1.0, narrow, Some(2.0), false).step, 200.0);
    }

    #[test]
    fn a_step_is_kept_while_something_is_turned_as_long_as_the_tip_is_in_view() {
        let step = |speed, before, pressed| Arrow::new(speed, 17.0, ground(25.0, 180.0), Some(before), pressed).step;
        // The mark needs 5 m/s per metre, the speed is content with 2.
        assert_eq!([step(5.0, 2.0, true), step(5.0, 2.0, false)], [2.0, 5.0]);
        // And back, where 2 would do.
        let roomy = |pressed| Arrow::new(5.0, 6.0, ground(25.0, 180.0), Some(5.0), pressed).step;
        assert_eq!([roomy(true), roomy(false)], [5.0, 2.0]);
        assert_eq!(step(13.0, 2.0, true), 5.0, "beyond the border");
    }

    #[test]
    fn room_ends_before_the_border() {
        let middle = canvas().center();
        assert!((room(canvas(), middle, Vec2::RIGHT) - 148.0).abs() < 1e-3);
        assert!((room(canvas(), middle, -Vec2::Y) - 136.0).abs() < 1e-3);
        assert!(room(canvas(), Pos2::new(-9.0, 0.0), Vec2::RIGHT).is_infinite());
    }
}
