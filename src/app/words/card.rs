//! The card of a word: what it means, with a picture, and where to read on.

use eframe::egui::{
    Align, Area, Color32, Context, CornerRadius, FontId, Frame, Id, Layout, Memory, Order, Painter, Pos2, Rect,
    Response, RichText, Role, ScrollArea, Sense, Shape, Stroke, StrokeKind, TextStyle, Ui, UiBuilder, Vec2, WidgetInfo,
};

use super::links;
use super::pictures::{self, Form, Ink, PicturePart};
use super::word::Word;
use crate::app::theme::{self, Tokens};

/// So wide is a card at most, with its edge, in points.
const WIDEST: f32 = 320.0;
/// Between its edge and its content.
const MARGIN: i8 = 12;
/// Between it and the edge of the screen.
const AROUND: f32 = 8.0;
/// A card that is opened so soon after a click is opened by it, in seconds.
const OF_A_CLICK: f32 = 0.3;

/// The card as it was shown last.
#[derive(Clone, Copy, Debug)]
struct Shown {
    word: Word,
    /// Where it was opened.
    at: Pos2,
    /// What had the keyboard's focus then, where it was opened by the keyboard: it gets the focus back.
    from: Option<Id>,
}

fn id() -> Id {
    Id::unique("word card")
}

fn shown(context: &Context) -> Option<Shown> {
    context.data(|data| data.get_temp(id()))
}

/// Whether a card is on the screen.
pub fn is_open(context: &Context) -> bool {
    shown(context).is_some()
}

/// Draws the card of the word that is open, in front of everything.
pub fn ui(open: &mut Option<Word>, context: &Context) {
    let before = shown(context);
    let Some(word) = *open else {
        if let Some(before) = before {
            put_away(context, before);
        }
        return;
    };
    let is_new = before.is_none_or(|before| before.word != word);
    let now = before.map_or_else(|| opened(context, word), |before| Shown { word, ..before });
    context.data_mut(|data| data.insert_temp(id(), now));

    let room = context.content_rect().shrink(AROUND);
    // The edge has a line on either side.
    let width = room.width().min(WIDEST) - 2.0 * (f32::from(MARGIN) + 1.0);
    let area = Area::new(id()).order(Order::Foreground).fixed_pos(now.at).constrain_to(room);
    let area = area.role(Role::Dialog).accessible_name(format!("Word: {}", word.title())).default_width(width);
    let (mut close, mut other) = (false, None);
    let card = area.show(context, |ui| {
        Frame::window(ui.style()).inner_margin(MARGIN).show(ui, |ui| {
            ui.set_width(width);
            let button = heading(ui, word);
            close = button.clicked();
            if is_new && now.from.is_some() {
                button.request_focus();
            }
            let height = room.height() - ui.min_rect().height() - 3.0 * f32::from(MARGIN);
            let scroll = ScrollArea::vertical().id_salt(word).max_height(height).min_scrolled_height(height);
            other = scroll.show(ui, |ui| content(ui, word)).inner;
        });
    });
    if other.is_some() {
        *open = other;
    } else if close || (!is_new && card.response.clicked_elsewhere()) {
        *open = None;
        if close {
            context.data_mut(|data| data.remove::<Shown>(id()));
            give_back(context, now);
        }
    }
}

/// A card that is opened now.
fn opened(context: &Context, word: Word) -> Shown {
    let (pointer, since) = context.input(|input| (input.pointer.interact_pos(), input.pointer.time_since_last_click()));
    if let Some(pointer) = pointer.filter(|_| since < OF_A_CLICK) {
        return Shown { word, at: pointer + Vec2::new(8.0, 16.0), from: None };
    }
    let from = context.memory(Memory::focused);
    let near = from.and_then(|from| context.read_response(from)).map(|link| link.rect.left_bottom());
    let middle = context.content_rect().center() - Vec2::new(0.5 * WIDEST, WIDEST);
    Shown { word, at: near.map_or(middle, |near| near + Vec2::new(0.0, AROUND)), from }
}

/// Forgets a card that was closed from elsewhere: by a key, or by a click beside it.
fn put_away(context: &Context, card: Shown) {
    context.data_mut(|data| data.remove::<Shown>(id()));
    // Esc takes the focus from everything; a click gives it to whatever it hits.
    if context.memory(Memory::focused).is_none() {
        give_back(context, card);
    }
}

fn give_back(context: &Context, card: Shown) {
    if let Some(from) = card.from {
        context.memory_mut(|memory| memory.request_focus(from));
    }
}

/// The word and the button that closes its card.
fn heading(ui: &mut Ui, word: Word) -> Response {
    let size = ui.spacing().interact_size.y.max(28.0);
    let (row, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), size), Sense::hover());
    let (left, right) = row.split_left_right_at_x(row.right() - size);
    let mut left = ui.new_child(UiBuilder::new().max_rect(left).layout(Layout::left_to_right(Align::Center)));
    left.heading(word.title());
    let response = ui.interact(right, ui.scope_id().with("close"), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), "Close"));
    let visuals = ui.style().interact(&response);
    if response.hovered() || response.has_focus() {
        let (ground, corners) = (right.shrink(1.0), CornerRadius::same(6));
        ui.painter().rect(ground, corners, visuals.weak_bg_fill, visuals.bg_stroke, StrokeKind::Inside);
    }
    let cross = Rect::from_center_size(right.center(), Vec2::splat(10.0));
    let stroke = Stroke::new(1.5, visuals.fg_stroke.color);
    ui.painter().line_segment([cross.left_top(), cross.right_bottom()], stroke);
    ui.painter().line_segment([cross.right_top(), cross.left_bottom()], stroke);
    response
}

/// What stands on the card; gives the word that was chosen to read on.
fn content(ui: &mut Ui, word: Word) -> Option<Word> {
    picture(ui, word);
    ui.add_space(4.0);
    ui.label(word.text());
    if let Some(equation) = word.equation() {
        ui.add_space(2.0);
        ui.label(RichText::new(equation).color(theme::tokens(ui.visuals()).weak));
    }
    ui.add_space(4.0);
    let mut chosen = None;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 12.0;
        ui.weak("See also");
        for other in word.see_also() {
            if links::in_list(ui, *other, other.title()).clicked() {
                chosen = Some(*other);
            }
        }
    });
    chosen
}

/// Paints the picture of a word, as large as the captions.
fn picture(ui: &mut Ui, word: Word) {
    let caption = TextStyle::Small.resolve(ui.style()).size;
    let [width, height] = pictures::SIZE;
    let scale = (caption / theme::CAPTION).min(ui.available_width() / width);
    let (ground, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), scale * height), Sense::hover());
    let tokens = theme::tokens(ui.visuals());
    ui.painter().rect_filled(ground, CornerRadius::same(6), tokens.panel);
    let place = PictureFrame { origin: ground.center() - 0.5 * scale * Vec2::new(width, height), scale };
    let font = FontId::proportional(scale * theme::CAPTION);
    for mark in pictures::of(word) {
        place.paint(ui.painter(), &mark, tokens, &font);
    }
}

/// Where a picture's frame is on the screen.
struct PictureFrame {
    origin: Pos2,
    scale: f32,
}

impl PictureFrame {
    fn at(&self, [x, y]: pictures::Point) -> Pos2 {
        self.origin + self.scale * Vec2::new(x, y)
    }

    fn paint(&self, painter: &Painter, mark: &PicturePart, tokens: &Tokens, font: &FontId) {
        match mark {
            PicturePart::Line(points, form, ink) => {
                let points: Vec<Pos2> = points.iter().map(|point| self.at(*point)).collect();
                let width = match form {
                    Form::Thin => 1.0,
                    Form::Dashed => 1.5,
                    Form::Solid => 2.0,
                };
                let stroke = Stroke::new(width, colour(*ink, tokens));
                if *form == Form::Dashed {
                    painter.extend(Shape::dashed_line(&points, stroke, 4.0 * self.scale, 3.0 * self.scale));
                } else {
                    painter.line(points, stroke);
                }
            }
            PicturePart::Arrow([from, to], ink) => {
                let (from, to) = (self.at(*from), self.at(*to));
                let stroke = Stroke::new(1.5, colour(*ink, tokens));
                let along = (to - from).normalized();
                painter.line_segment([from, to], stroke);
                for across in [along.rot90(), -along.rot90()] {
                    painter.line_segment([to, to + self.scale * (3.0 * across - 5.0 * along)], stroke);
                }
            }
            PicturePart::Dot(at, radius, ink) => {
                painter.circle_filled(self.at(*at), self.scale * radius, colour(*ink, tokens));
            }
            PicturePart::Bar([low, high], ink) => {
                let bar = Rect::from_two_pos(self.at(*low), self.at(*high));
                painter.rect_filled(bar, CornerRadius::ZERO, colour(*ink, tokens));
            }
            PicturePart::Text(at, part, text, ink) => {
                let galley = painter.layout_no_wrap((*text).into(), font.clone(), colour(*ink, tokens));
                let corner = self.at(*at) - Vec2::new(part * galley.size().x, 0.5 * galley.size().y);
                painter.galley(corner, galley, Color32::PLACEHOLDER);
            }
        }
    }
}

fn colour(ink: Ink, tokens: &Tokens) -> Color32 {
    match ink {
        Ink::Frame => tokens.mute,
        Ink::Weak => tokens.weak,
        Ink::Accent => tokens.accent,
        Ink::Stable => tokens.stable,
        Ink::Critical => tokens.critical,
        Ink::Waves => tokens.waves,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::command::Command;
    use eframe::egui::Key;
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable;

    /// A page with one link.
    fn page(size: Vec2, coarse: bool) -> Harness<'static, Option<Word>> {
        let draw = |ui: &mut Ui, open: &mut Option<Word>| {
            if is_open(ui.ctx()) && ui.input(|input| input.key_pressed(Key::Escape)) {
                *open = None;
            }
            let mut commands = Vec::new();
            links::link(ui, Word::Flutter, "flutters", &mut commands);
            if let Some(Command::ExplainWord(word)) = commands.pop() {
                *open = Some(word);
            }
            super::ui(open, ui.ctx());
        };
        let setup = move |context: &Context| {
            theme::install_fonts(context);
            theme::install_style(context, coarse);
        };
        let mut page = Harness::builder().with_size(size).with_context_setup(setup).build_ui_state(draw, None);
        page.run_steps(2);
        page
    }

    #[test]
    fn every_card_is_whole_on_every_screen() {
        for (width, height, coarse) in [(320.0, 640.0, true), (600.0, 400.0, false), (740.0, 360.0, true)] {
            let mut page = page(Vec2::new(width, height), coarse);
            for word in Word::ALL {
                *page.state_mut() = Some(word);
                page.run_steps(4);
                let card = page.ctx.memory(|memory| memory.area_rect(id())).expect("a card");
                let screen = Rect::from_min_size(Pos2::ZERO, Vec2::new(width, height));
                assert!(screen.contains_rect(card), "{word:?} on {screen:?}: {card:?}");
                assert!(card.width() <= WIDEST + 0.5, "{word:?}: {card:?}");
                let close = page.get_by_role_and_label(Role::Button, "Close").rect();
                assert!(card.contains_rect(close), "{word:?}: {close:?}");
            }
        }
    }

    #[test]
    fn a_card_opens_leads_on_and_closes_by_button_by_esc_and_by_a_click_elsewhere() {
        let mut page = page(Vec2::new(800.0, 700.0), false);
        for way in 0..3 {
            page.get_by_role_and_label(Role::Link, "flutters").click();
            page.run_steps(3);
            assert_eq!(*page.state(), Some(Word::Flutter));
            page.get_by_label("Word: Flutter");
            page.get_by_role_and_label(Role::Link, "Divergence").click();
            page.run_steps(3);
            assert_eq!(*page.state(), Some(Word::Divergence));
            match way {
                0 => page.get_by_role_and_label(Role::Button, "Close").click(),
                1 => page.key_press(Key::Escape),
                _ => {
                    let elsewhere = Pos2::new(790.0, 690.0);
                    page.drag_at(elsewhere);
                    page.step();
                    page.drop_at(elsewhere);
                }
            }
            page.run_steps(3);
            assert_eq!(*page.state(), None, "{way}");
            assert!(!is_open(&page.ctx) && page.query_by_label("Word: Divergence").is_none(), "{way}");
        }
    }
}
