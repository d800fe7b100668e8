//! Pictures of the interface without a graphics card. They show what a window would show, and take a second each.

#![allow(dead_code, reason = "every test file takes only what it needs")]

use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;

use eframe::egui::{Color32, ColorImage, TexturesDelta};
use egui_kittest::{Harness, TestRenderer};
use tautline::app::raster;

/// The textures that the interface has asked for so far.
#[derive(Clone, Default)]
pub struct Textures(Rc<RefCell<raster::Textures>>);

impl TestRenderer for Textures {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        self.0.borrow_mut().take(delta);
        delta.clear();
    }
}

/// What is on the screen now, in pixels of a point each.
pub fn picture<T>(app: &Harness<'_, T>, textures: &Textures) -> ColorImage {
    let size = app.ctx.content_rect().size() * app.ctx.pixels_per_point();
    let output = app.output();
    let primitives = app.ctx.tessellate(output.shapes.clone(), output.pixels_per_point);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // A screen.
    let mut image = ColorImage::filled([size.x.round() as usize, size.y.round() as usize], Color32::WHITE);
    raster::fill(&mut image, &primitives, &textures.0.borrow(), output.pixels_per_point);
    image
}

/// Writes a picture as a PNG.
pub fn write(image: &ColorImage, path: &Path) {
    let bytes = raster::png(image).expect("a picture");
    std::fs::write(path, bytes).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}

/// Reads a picture back, whether it has an opacity or not.
pub fn read(path: &Path) -> Option<ColorImage> {
    let file = std::io::BufReader::new(std::fs::File::open(path).ok()?);
    let mut reader = png::Decoder::new(file).read_info().ok()?;
    let mut bytes = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut bytes).ok()?;
    let (size, bytes) = ([info.width as usize, info.height as usize], &bytes[..info.buffer_size()]);
    Some(match info.color_type {
        png::ColorType::Rgba => ColorImage::from_rgba_unmultiplied(size, bytes),
        _ => ColorImage::from_rgb(size, bytes),
    })
}
