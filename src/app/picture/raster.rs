//! Pictures without a graphics card: the triangles of an interface are filled one by one.

use std::collections::HashMap;

use eframe::egui::epaint::{ClippedPrimitive, ImageData, Primitive, TextureId, Vertex};
use eframe::egui::{Color32, ColorImage, Pos2, Rect, TexturesDelta, Vec2};

/// The images that triangles take their colours from: letters, and whatever else is drawn as an image.
#[derive(Clone, Debug, Default)]
pub struct Textures(HashMap<TextureId, ColorImage>);

impl Textures {
    /// Takes in the changes of a pass.
    pub fn take(&mut self, delta: &TexturesDelta) {
        for (id, changes) in &delta.set {
            for change in changes {
                let ImageData::Color(image) = &change.image;
                let Some([left, top]) = change.pos else {
                    self.0.insert(*id, (**image).clone());
                    continue;
                };
                let Some(whole) = self.0.get_mut(id) else { continue };
                for y in 0..image.height() {
                    for x in 0..image.width() {
                        whole[(left + x, top + y)] = image[(x, y)];
                    }
                }
            }
        }
        for id in &delta.free {
            self.0.remove(id);
        }
    }

    /// An image, where there is one of this name.
    pub fn get(&self, id: TextureId) -> Option<&ColorImage> {
        self.0.get(&id)
    }
}

/// Fills triangles, whose corners are in points, with `scale` pixels of `image` to a point.
pub fn fill(image: &mut ColorImage, primitives: &[ClippedPrimitive], textures: &Textures, scale: f32) {
    #[expect(clippy::cast_precision_loss)] // A few thousand pixels.
    let whole = Rect::from_min_size(Pos2::ZERO, Vec2::from(image.size.map(|side| side as f32)));
    for ClippedPrimitive { clip_rect, primitive } in primitives {
        let Primitive::Mesh(mesh) = primitive else { continue };
        let Some(texture) = textures.get(mesh.texture_id) else { continue };
        let clip = (*clip_rect * scale).intersect(whole);
        for corners in mesh.indices.chunks_exact(3) {
            let corner = |i: usize| mesh.vertices.get(corners[i] as usize).copied();
            if let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) {
                triangle(image, [a, b, c], texture, clip, scale);
            }
        }
    }
}

fn cross(p: Vec2, q: Vec2) -> f32 {
    p.x * q.y - p.y * q.x
}

fn triangle(image: &mut ColorImage, corners: [Vertex; 3], texture: &ColorImage, clip: Rect, scale: f32) {
    let [a, b, c] = corners.map(|corner| corner.pos.to_vec2() * scale);
    let area = cross(b - a, c - a);
    if area.abs() < 1e-6 || !area.is_finite() {
        return;
    }
    let bounds = Rect::from_points(&[a.to_pos2(), b.to_pos2(), c.to_pos2()]).intersect(clip);
    if bounds.width() < 0.0 || bounds.height() < 0.0 {
        return;
    }
    let edges = [(b, c), (c, a), (a, b)];
    for y in pixels(bounds.top(), bounds.bottom(), image.height()) {
        #[expect(clippy::cast_precision_loss)] // A few thousand pixels.
        let middle = y as f32 + 0.5;
        // Each corner's weight changes evenly along the row, so that the row's part in the triangle is known at once.
        let (mut left, mut right) = (bounds.left(), bounds.right());
        for (from, to) in edges {
            let slope = -(to.y - from.y) / area;
            let start = cross(to - from, Vec2::new(0.0, middle) - from) / area;
            if slope > 0.0 {
                left = left.max(-start / slope - 1.0);
            } else if slope < 0.0 {
                right = right.min(-start / slope + 1.0);
            }
        }
        for x in pixels(left, right, image.width()) {
            #[expect(clippy::cast_precision_loss)] // As above.
            let at = Pos2::new(x as f32 + 0.5, middle);
            let weights = edges.map(|(from, to)| cross(to - from, at.to_vec2() - from) / area);
            if clip.contains(at) && weights.iter().all(|weight| *weight >= 0.0) {
                image[(x, y)] = over(corners, weights, texture, image[(x, y)]);
            }
        }
    }
}

/// The pixels between two places of a row or column that has `most` of them.
fn pixels(low: f32, high: f32, most: usize) -> std::ops::Range<usize> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Negative numbers become 0.
    let [low, high] = [low.floor() as usize, high.ceil() as usize];
    low..high.min(most)
}

/// A point of a triangle laid over the colour that is there.
fn over(corners: [Vertex; 3], weights: [f32; 3], texture: &ColorImage, under: Color32) -> Color32 {
    let mix = |value: fn(&Vertex) -> f32| (0..3).map(|i| weights[i] * value(&corners[i])).sum::<f32>();
    let dot = sample(texture, mix(|corner| corner.uv.x), mix(|corner| corner.uv.y));
    let tint = [
        mix(|corner| corner.color.r().into()),
        mix(|corner| corner.color.g().into()),
        mix(|corner| corner.color.b().into()),
        mix(|corner| corner.color.a().into()),
    ];
    let opacity = tint[3] * dot[3] / 255.0;
    let under = under.to_array();
    let [r, g, b] = [0, 1, 2].map(|i| {
        let value = tint[i] * dot[i] / 255.0 + f32::from(under[i]) * (1.0 - opacity / 255.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Clamped.
        let byte = value.round().clamp(0.0, 255.0) as u8;
        byte
    });
    Color32::from_rgb(r, g, b)
}

/// The texture's colour at a place, between its four nearest dots.
fn sample(texture: &ColorImage, u: f32, v: f32) -> [f32; 4] {
    let [width, height] = texture.size;
    let along = |part: f32, count: usize| {
        #[expect(clippy::cast_precision_loss)] // A few thousand dots.
        let at = (part * count as f32 - 0.5).clamp(0.0, count.saturating_sub(1) as f32);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Clamped.
        let first = at as usize;
        (first, (first + 1).min(count.saturating_sub(1)), at.fract())
    };
    let ((left, right, x), (top, bottom, y)) = (along(u, width), along(v, height));
    let dot = |x: usize, y: usize| texture[(x, y)].to_array().map(f32::from);
    let first = dot(left, top);
    if x < 0.01 && y < 0.01 {
        return first;
    }
    let others = [dot(right, top), dot(left, bottom), dot(right, bottom)];
    [0, 1, 2, 3].map(|i| {
        let upper = first[i] + (others[0][i] - first[i]) * x;
        let lower = others[1][i] + (others[2][i] - others[1][i]) * x;
        upper + (lower - upper) * y
    })
}

/// A picture as a PNG file.
///
/// # Errors
/// Says why where the picture is larger than such a file can be.
pub fn png(image: &ColorImage) -> Result<Vec<u8>, String> {
    let too_large = |error: std::num::TryFromIntError| error.to_string();
    let [width, height] = image.size;
    let (width, height) = (u32::try_from(width).map_err(too_large)?, u32::try_from(height).map_err(too_large)?);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    let data: Vec<u8> = image.pixels.iter().flat_map(Color32::to_srgba_unmultiplied).collect();
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&data));
    written.map_err(|error| error.to_string())?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::epaint::Mesh;

    #[test]
    fn pictures_are_png_files_of_their_size_and_colours() {
        let mut image = ColorImage::filled([3, 2], Color32::from_rgb(10, 200, 30));
        image.pixels[4] = Color32::from_rgb(1, 2, 3);
        let bytes = png(&image).expect("a picture");
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG file");
        let mut data = vec![0; 24];
        reader.next_frame(&mut data).expect("its pixels");
        assert_eq!((reader.info().width, reader.info().height), (3, 2));
        assert_eq!((&data[..4], &data[16..20]), (&[10, 200, 30, 255][..], &[1, 2, 3, 255][..]));
    }

    /// The pixels whose middles lie in a triangle have its colour, those outside of it and of the clip keep theirs.
    #[test]
    fn a_triangle_covers_the_pixels_whose_middles_it_holds() {
        let mut textures = Textures::default();
        textures.0.insert(TextureId::default(), ColorImage::filled([2, 2], Color32::WHITE));
        let corners = [Pos2::new(1.0, 1.0), Pos2::new(9.0, 2.0), Pos2::new(3.0, 8.0)];
        let mut mesh = Mesh::default();
        for corner in corners {
            mesh.colored_vertex(corner, Color32::RED);
        }
        mesh.add_triangle(0, 1, 2);
        let clip_rect = Rect::from_min_max(Pos2::ZERO, Pos2::new(6.0, 10.0));
        let primitive = ClippedPrimitive { clip_rect, primitive: Primitive::Mesh(mesh) };
        let mut image = ColorImage::filled([20, 20], Color32::WHITE);
        fill(&mut image, &[primitive], &textures, 2.0);
        let side = |p: Pos2, q: Pos2, at: Pos2| (q - p).x * (at - p).y - (q - p).y * (at - p).x >= 0.0;
        for y in 0..20_u8 {
            for x in 0..20_u8 {
                let at = Pos2::new(f32::from(x) + 0.5, f32::from(y) + 0.5) / 2.0;
                let inside = (0..3).all(|i| side(corners[i], corners[(i + 1) % 3], at)) && at.x <= 6.0;
                let expected = if inside { Color32::RED } else { Color32::WHITE };
                assert_eq!(image[(x.into(), y.into())], expected, "{x} {y}");
            }
        }
    }

    #[test]
    fn images_are_smooth_between_their_dots() {
        let texture = ColorImage::new([2, 1], vec![Color32::BLACK, Color32::WHITE]);
        for (u, expected) in [(0.0, 0.0), (0.25, 0.0), (0.5, 127.5), (0.625, 191.25), (0.75, 255.0), (1.0, 255.0)] {
            let [red, ..] = sample(&texture, u, 0.5);
            assert!((red - expected).abs() < 0.01, "{u}: {red}");
        }
    }
}
