//! Pictures for papers and slides. What is on the screen is drawn once more, alone and at a size of its own, in a context
//! that knows no pointer, so that nothing in it is hovered, focused or to be pressed. The shapes become an SVG file, or the
//! pixels of a PNG file.

mod caption;
pub mod raster;
mod svg;
#[cfg(test)]
mod tests;

use eframe::egui::epaint::ClippedShape;
use eframe::egui::{Color32, ColorImage, Context, Pos2, RawInput, Rect, TextStyle, Theme, Ui, UiBuilder, Vec2};

pub use caption::{caption, name};

use crate::app::theme;
use raster::Textures;

/// The size of a plot's picture, in points.
pub const PLOT: Vec2 = Vec2::new(800.0, 500.0);
/// Pixels of a PNG file to a point.
const SCALE: f32 = 2.0;
/// Tables find the widths of their columns in the first passes.
const PASSES: usize = 3;
/// Room at the edges, in points.
const MARGIN: f32 = 16.0;

/// The kinds of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Pixels, two to a point.
    Png,
    /// Lines and letters.
    Svg,
}

impl Format {
    /// How names of such files end.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Png => ".png",
            Self::Svg => ".svg",
        }
    }
}

/// What a picture has besides its content.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// What is seen.
    pub title: &'a str,
    /// What it belongs to.
    pub caption: &'a str,
    /// In points, with title and caption.
    pub size: Vec2,
    /// Light or dark.
    pub theme: Theme,
    /// Under everything.
    pub ground: Color32,
    /// Whether the content has margins; else it goes from edge to edge.
    pub margins: bool,
    /// The time in s, as what is drawn knows it.
    pub time: f64,
}

/// A picture as shapes.
pub struct Picture<'a> {
    frame: Frame<'a>,
    context: Context,
    shapes: Vec<ClippedShape>,
    textures: Textures,
}

impl<'a> Picture<'a> {
    /// Draws a title, the content, and a caption of as many lines as it needs.
    pub fn new(frame: Frame<'a>, content: &mut dyn FnMut(&mut Ui)) -> Self {
        let context = Context::default();
        theme::install_fonts(&context);
        theme::install_style(&context, false);
        context.set_theme(frame.theme);
        let mut picture = Self { frame, context, shapes: Vec::new(), textures: Textures::default() };
        for _ in 0..PASSES {
            let mut input = RawInput {
                screen_rect: Some(Rect::from_min_size(Pos2::ZERO, frame.size)),
                time: Some(frame.time),
                ..RawInput::default()
            };
            if let Some(window) = input.viewports.get_mut(&input.viewport_id) {
                window.native_pixels_per_point = Some(SCALE);
            }
            let mut output = picture.context.run_ui(input, |ui| frame.draw(ui, content));
            picture.textures.take(&output.textures_delta);
            output.textures_delta.clear();
            picture.shapes = output.shapes;
        }
        picture
    }

    /// The file's content.
    ///
    /// # Errors
    /// Says why it cannot be made.
    pub fn file(self, format: Format) -> Result<Vec<u8>, String> {
        match format {
            Format::Svg => {
                let words = [self.frame.title, self.frame.caption];
                svg::write(&self.shapes, self.frame.size, words, &self.textures).map(String::into_bytes)
            }
            Format::Png => {
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // A few thousand pixels.
                let size = [self.frame.size.x, self.frame.size.y].map(|side| (side * SCALE).round() as usize);
                let mut image = ColorImage::filled(size, self.frame.ground);
                let primitives = self.context.tessellate(self.shapes, SCALE);
                raster::fill(&mut image, &primitives, &self.textures, SCALE);
                raster::png(&image)
            }
        }
    }
}

impl Frame<'_> {
    fn draw(&self, ui: &mut Ui, content: &mut dyn FnMut(&mut Ui)) {
        let tokens = theme::tokens(ui.visuals());
        let whole = Rect::from_min_size(Pos2::ZERO, self.size);
        let painter = ui.painter_at(whole);
        painter.rect_filled(whole, 0.0, self.ground);
        let width = self.size.x - 2.0 * MARGIN;
        let title = painter.layout(self.title.into(), TextStyle::Heading.resolve(ui.style()), tokens.text, width);
        let caption = painter.layout(self.caption.into(), TextStyle::Small.resolve(ui.style()), tokens.weak, width);
        let side = if self.margins { MARGIN } else { 0.0 };
        let room = Rect::from_min_max(
            Pos2::new(side, MARGIN + title.size().y + 8.0),
            Pos2::new(self.size.x - side, self.size.y - 12.0 - caption.size().y - 10.0),
        );
        painter.galley(Pos2::new(MARGIN, 12.0), title, tokens.text);
        painter.galley(Pos2::new(MARGIN, room.max.y + 10.0), caption, tokens.weak);
        ui.scope_builder(UiBuilder::new().max_rect(room), |ui| {
            ui.set_clip_rect(room);
            content(ui);
        });
    }
}
