//! Where the tour's box is, so that it does not cover what it is about.

use eframe::egui::{Pos2, Rect, Vec2};

/// Between the box and what it is beside.
const GAP: f32 = 8.0;

/// The top left corner of a box of this size: on the screen, and beside `about` where there is room, below it rather than at
/// its sides, and there rather than above it. Where there is room nowhere, it is where it covers least of `about`.
pub fn beside(screen: Rect, about: Rect, size: Vec2) -> Pos2 {
    let about = about.intersect(screen);
    // What is not drawn has no place.
    let about = if about.is_positive() { about } else { screen };
    let screen = screen.shrink(GAP);
    let middle = about.center().x - 0.5 * size.x;
    // At a side it is low: what matters is mostly high up.
    let low = about.bottom() - size.y - GAP;
    let places = [
        Pos2::new(middle, about.bottom() + GAP),
        Pos2::new(about.right() + GAP, low),
        Pos2::new(about.left() - size.x - GAP, low),
        Pos2::new(middle, about.top() - size.y - GAP),
    ];
    let on_screen = |place: Pos2| place.clamp(screen.min, (screen.max - size).max(screen.min));
    let covered = |place: &Pos2| {
        let both = Rect::from_min_size(*place, size).intersect(about);
        both.width().max(0.0) * both.height().max(0.0)
    };
    // Of equals the first one.
    places.map(on_screen).into_iter().min_by(|one, other| covered(one).total_cmp(&covered(other))).unwrap_or(screen.min)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rect(x: f32, y: f32, width: f32, height: f32) -> Rect {
        Rect::from_min_size(Pos2::new(x, y), Vec2::new(width, height))
    }

    /// Screens with the robot or with a plot on them, as the mock-ups have them.
    #[test]
    fn the_box_is_on_the_screen_and_covers_nothing_of_what_it_is_about() {
        let phone = rect(0.0, 0.0, 360.0, 740.0);
        let cases = [
            ("phone, robot and answer line", phone, rect(0.0, 48.0, 360.0, 376.0)),
            ("phone, plot", phone, rect(0.0, 520.0, 360.0, 220.0)),
            ("small phone", rect(0.0, 0.0, 320.0, 640.0), rect(0.0, 48.0, 320.0, 334.0)),
            ("phone held across, robot", rect(0.0, 0.0, 740.0, 360.0), rect(0.0, 44.0, 420.0, 316.0)),
            ("desktop, robot", rect(0.0, 0.0, 1280.0, 800.0), rect(272.0, 40.0, 720.0, 508.0)),
            ("desktop, plot", rect(0.0, 0.0, 1280.0, 800.0), rect(992.0, 40.0, 288.0, 760.0)),
            ("plot in the dock", rect(0.0, 0.0, 1024.0, 768.0), rect(0.0, 448.0, 1024.0, 276.0)),
            ("wide, upper plot", rect(0.0, 0.0, 1920.0, 1080.0), rect(1360.0, 40.0, 560.0, 520.0)),
        ];
        for (name, screen, about) in cases {
            let size = Vec2::new(300.0, 150.0);
            let found = Rect::from_min_size(beside(screen, about, size), size);
            assert!(screen.contains_rect(found), "{name}: {found:?}");
            let both = found.intersect(about);
            assert!(both.width() <= 0.0 || both.height() <= 0.0, "{name}: {found:?} covers {about:?}");
        }
    }

    #[test]
    fn where_there_is_no_room_it_stays_on_the_screen_and_low() {
        let screen = rect(0.0, 0.0, 600.0, 400.0);
        let size = Vec2::new(300.0, 150.0);
        let found = Rect::from_min_size(beside(screen, screen, size), size);
        assert!(screen.contains_rect(found) && found.bottom() > 380.0, "{found:?}");
        // A box that is larger than the screen begins at its corner; nothing panics.
        assert_eq!(beside(screen, screen, Vec2::splat(1000.0)), Pos2::new(GAP, GAP));
        // What was never drawn has no place: the box goes somewhere on the screen.
        let found = Rect::from_min_size(beside(screen, Rect::NOTHING, size), size);
        assert!(screen.contains_rect(found), "{found:?}");
    }
}
