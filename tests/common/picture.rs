//! Pictures of the interface without a graphics card: its triangles are filled one by one. They show what a window
//! would show, but for the smoothing of edges, and take a second each.

#![allow(dead_code, reason = "every test file takes only what it needs")]

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::Path;
use std::rc::Rc;

use eframe::egui::epaint::{ClippedPrimitive, ImageData, Primitive, TextureId, Vertex};
use eframe::egui::{Color32, ColorImage, Pos2, Rect, TexturesDelta};
use egui_kittest::{Harness, TestRenderer};

/// The textures that the interface has asked for so far.
#[derive(Clone, Default)]
pub struct Textures(Rc<RefCell<HashMap<TextureId, ColorImage>>>);

impl TestRenderer for Textures {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        let mut textures = self.0.borrow_mut();
        for (id, changes) in &delta.set {
            for change in changes {
                let ImageData::Color(image) = &change.image;
                match change.pos {
                    None => _ = textures.insert(*id, (**image).clone()),
                    Some([left, top]) => {
                        let whole = textures.get_mut(id).expect("a texture that is changed is there");
                        for y in 0..image.height() {
                            for x in 0..image.width() {
                                whole[(left + x, top + y)] = image[(x, y)];
                            }
                        }
                    }
                }
            }
        }
        for id in &delta.free {
            textures.remove(id);
        }
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
    for primitive in &primitives {
        fill(&mut image, primitive, &textures.0.borrow(), output.pixels_per_point);
    }
    image
}

fn fill(
    image: &mut ColorImage,
    ClippedPrimitive { clip_rect, primitive }: &ClippedPrimitive,
    textures: &HashMap<TextureId, ColorImage>,
    scale: f32,
) {
    let Primitive::Mesh(mesh) = primitive else { return };
    let texture = &textures[&mesh.texture_id];
    let whole = Rect::from_min_size(Pos2::ZERO, [image.width() as f32, image.height() as f32].into());
    let clip = (*clip_rect * scale).intersect(whole);
    for corners in mesh.indices.chunks_exact(3) {
        let corners = [0, 1, 2].map(|i| mesh.vertices[corners[i] as usize]);
        triangle(image, corners, texture, clip, scale);
    }
}

fn triangle(image: &mut ColorImage, corners: [Vertex; 3], texture: &ColorImage, clip: Rect, scale: f32) {
    let [a, b, c] = corners.map(|corner| corner.pos.to_vec2() * scale);
    let cross = |p: eframe::egui::Vec2, q: eframe::egui::Vec2| p.x * q.y - p.y * q.x;
    let area = cross(b - a, c - a);
    if area.abs() < 1e-6 || !area.is_finite() {
        return;
    }
    let bounds = Rect::from_points(&[a.to_pos2(), b.to_pos2(), c.to_pos2()]).intersect(clip);
    if bounds.width() < 0.0 || bounds.height() < 0.0 {
        return;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Within the image.
    let range = |low: f32, high: f32, most: usize| low.floor() as usize..(high.ceil() as usize).min(most);
    for y in range(bounds.top(), bounds.bottom(), image.height()) {
        for x in range(bounds.left(), bounds.right(), image.width()) {
            let at = Pos2::new(x as f32 + 0.5, y as f32 + 0.5);
            let p = at.to_vec2();
            let parts = [cross(c - b, p - b), cross(a - c, p - c), cross(b - a, p - a)].map(|part| part / area);
            if !clip.contains(at) || parts.iter().any(|part| *part < 0.0) {
                continue;
            }
            let mix = |value: fn(&Vertex) -> f32| (0..3).map(|i| parts[i] * value(&corners[i])).sum::<f32>();
            let texel = |part: f32, size: usize| {
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Within the texture.
                let texel = (part * size as f32).clamp(0.0, size as f32 - 1.0) as usize;
                texel
            };
            let dot = texture[(texel(mix(|v| v.uv.x), texture.width()), texel(mix(|v| v.uv.y), texture.height()))];
            let tint = [mix(|v| v.color.r().into()), mix(|v| v.color.g().into()), mix(|v| v.color.b().into())];
            let over = mix(|v| v.color.a().into()) * f32::from(dot.a()) / 255.0;
            let under = image[(x, y)].to_array();
            let channel = |i: usize| {
                let above = tint[i] * f32::from(dot.to_array()[i]) / 255.0;
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Clamped.
                let byte = (above + f32::from(under[i]) * (1.0 - over / 255.0)).round().clamp(0.0, 255.0) as u8;
                byte
            };
            image[(x, y)] = Color32::from_rgb(channel(0), channel(1), channel(2));
        }
    }
}

/// Writes a picture as a PNG.
pub fn write(image: &ColorImage, path: &Path) {
    let file = std::fs::File::create(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let [width, height] = image.size.map(|side| u32::try_from(side).expect("a screen"));
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let bytes: Vec<u8> = image.pixels.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&bytes).expect("a picture");
}

/// Reads a picture back.
pub fn read(path: &Path) -> Option<ColorImage> {
    let file = std::io::BufReader::new(std::fs::File::open(path).ok()?);
    let mut reader = png::Decoder::new(file).read_info().ok()?;
    let mut bytes = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut bytes).ok()?;
    Some(ColorImage::from_rgb([info.width as usize, info.height as usize], &bytes[..info.buffer_size()]))
}
