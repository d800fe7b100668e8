//! The model on one page.

mod page;

use eframe::egui::{Color32, ColorImage, Context, Image, TextureHandle, TextureOptions, Ui};

use page::{PAGE, Part};

/// Pixels of an equation's picture per point of the screen, as docs/equations/render.py draws them.
const SCALE: f32 = 3.0;
/// Longer lines are hard to read; in points.
pub const WIDEST: f32 = 560.0;

/// The equations' pictures, made when the window opens for the first time.
#[derive(Default)]
pub struct Pictures {
    /// One for each part of the page: none for text, nor where a picture cannot be read.
    of_parts: Vec<Option<TextureHandle>>,
    /// The screen's pixels per point that they were made for.
    pixels_per_point: f32,
}

/// Draws the page.
pub fn ui(pictures: &mut Pictures, ui: &mut Ui) {
    let pixels_per_point = ui.pixels_per_point();
    if pictures.of_parts.is_empty() || pictures.pixels_per_point.total_cmp(&pixels_per_point).is_ne() {
        let of_parts = PAGE.iter().map(|part| upload(ui.ctx(), part, pixels_per_point)).collect();
        *pictures = Pictures { of_parts, pixels_per_point };
    }
    ui.set_max_width(ui.available_width().min(WIDEST));
    for (part, picture) in PAGE.iter().zip(&pictures.of_parts) {
        match part {
            Part::Heading(text) => {
                ui.add_space(12.0);
                ui.heading(*text);
                ui.add_space(2.0);
            }
            Part::Text(text) => {
                ui.label(*text);
                ui.add_space(3.0);
            }
            Part::Link(text, address) => {
                ui.hyperlink_to(*text, *address);
            }
            Part::Equation { words, .. } => equation(ui, words, picture.as_ref()),
        }
    }
}

/// Draws an equation in the colour of the text, smaller where there is no room for it.
fn equation(ui: &mut Ui, words: &str, picture: Option<&TextureHandle>) {
    let Some(picture) = picture else {
        ui.weak(words);
        return;
    };
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        ui.add_space(8.0);
        let size = picture.size_vec2() / ui.pixels_per_point().min(SCALE);
        let size = size * (ui.available_width() / size.x).min(1.0);
        let image = Image::new((picture.id(), size)).tint(ui.visuals().strong_text_color()).alt_text(words);
        ui.add_sized(size, image);
    });
    ui.add_space(4.0);
}

/// Makes the picture of an equation as fine as the screen is, but no finer than it is drawn.
fn upload(context: &Context, part: &Part, pixels_per_point: f32) -> Option<TextureHandle> {
    let Part::Equation { name, picture, .. } = part else { return None };
    let (size, ink) = mask(picture)?;
    let factor = (pixels_per_point / SCALE).min(1.0);
    // Positive, and far below 2^24.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let target = size.map(|pixels| ((pixels as f32 * factor).round() as usize).max(1));
    let pixels = shrink(&ink, size, target).into_iter().map(Color32::from_white_alpha).collect();
    Some(context.load_texture(*name, ColorImage::new(target, pixels), TextureOptions::LINEAR))
}

/// The same picture with fewer pixels. Each is the mean of the pixels that it covers. The screen's own scaling would look at four
/// pixels only and lose thin strokes.
fn shrink(ink: &[u8], size: [usize; 2], target: [usize; 2]) -> Vec<u8> {
    let [columns, rows] = [0, 1].map(|i| (0..target[i]).map(|k| covered(k, target[i], size[i])).collect::<Vec<_>>());
    let mut pixels = Vec::with_capacity(target[0] * target[1]);
    for row in &rows {
        for column in &columns {
            let mut sum = 0.0;
            for (y, height) in row {
                for (x, width) in column {
                    sum += height * width * f32::from(ink[y * size[0] + x]);
                }
            }
            // Means of bytes are within 0..=255.
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            pixels.push(sum.round() as u8);
        }
    }
    pixels
}

/// What the k-th of `count` equal pieces covers of `pixels` pixels: each with its share of the piece.
fn covered(k: usize, count: usize, pixels: usize) -> Vec<(usize, f32)> {
    let piece = pixels as f32 / count as f32;
    let (start, end) = (k as f32 * piece, (k + 1) as f32 * piece);
    let share = |x: usize| (((x + 1) as f32).min(end) - (x as f32).max(start)).max(0.0) / piece;
    let first = k * pixels / count;
    let last = ((k + 1) * pixels).div_ceil(count).min(pixels);
    (first..last).map(|x| (x, share(x))).collect()
}

/// Size and ink of an equation's picture, a byte for each pixel; `None` where the bytes are no picture.
///
/// The bytes are width and height as 16-bit numbers, high byte first, then a byte for each run of equal pixels: the ink
/// in the upper four bits, the length of the run less one in the lower four. docs/equations/render.py writes them.
fn mask(picture: &[u8]) -> Option<([usize; 2], Vec<u8>)> {
    let ([a, b, c, d], runs) = picture.split_first_chunk()?;
    let size = [[*a, *b], [*c, *d]].map(|pixels| usize::from(u16::from_be_bytes(pixels)));
    // Four bits become eight: 15 is 255.
    let run = |run: &u8| std::iter::repeat_n(17 * (run >> 4), usize::from(run & 15) + 1);
    let ink: Vec<u8> = runs.iter().flat_map(run).collect();
    (!ink.is_empty() && ink.len() == size[0] * size[1]).then_some((size, ink))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_equation_is_a_picture_that_fits_a_phone() {
        let mut count = 0;
        for part in PAGE {
            let Part::Equation { name, words, picture } = part else { continue };
            let ([width, height], ink) = mask(picture).unwrap_or_else(|| panic!("{name} cannot be read"));
            assert!(width as f32 / SCALE <= 320.0, "{name} is {width} pixels wide");
            assert!(height as f32 / SCALE <= 130.0, "{name} is {height} pixels high");
            // Full ink and none; what lies between is the edges.
            let share = |levels: std::ops::RangeInclusive<u8>| {
                ink.iter().filter(|value| levels.contains(value)).count() as f32 / ink.len() as f32
            };
            let (full, none) = (share(255..=255), share(0..=0));
            assert!(full > 0.005 && none > 0.5, "{name}: {full} {none}");
            assert!(words.len() > 10, "{name}: {words}");
            count += 1;
        }
        assert!(count > 15, "{count} pictures");
    }

    /// The PNGs are what people look at in the folder.
    #[test]
    fn every_picture_has_the_pixels_of_its_png() {
        for part in PAGE {
            let Part::Equation { name, picture, .. } = part else { continue };
            let path = format!("{}/docs/equations/{name}.png", env!("CARGO_MANIFEST_DIR"));
            let file = std::fs::File::open(&path).expect("a PNG");
            let mut decoder = png::Decoder::new(std::io::BufReader::new(file));
            // Four bits become eight.
            decoder.set_transformations(png::Transformations::EXPAND);
            let mut reader = decoder.read_info().expect("a PNG");
            let mut ink = vec![0; reader.output_buffer_size().expect("a size")];
            let info = reader.next_frame(&mut ink).expect("pixels");
            let size = [info.width, info.height].map(|pixels| usize::try_from(pixels).expect("a size"));
            assert!(mask(picture) == Some((size, ink)), "{name}: run docs/equations/render.py");
        }
    }

    #[test]
    fn fewer_pixels_hold_as_much_ink() {
        // Two fifths of each third are ink.
        assert_eq!(shrink(&[0, 255, 0, 255, 0], [5, 1], [3, 1]), [102, 102, 102]);
        assert_eq!(shrink(&[0, 100, 200, 100], [2, 2], [1, 1]), [100]);
        let same: Vec<u8> = (0..12).collect();
        assert_eq!(shrink(&same, [4, 3], [4, 3]), same);
        for part in PAGE {
            let Part::Equation { name, picture, .. } = part else { continue };
            let (size, ink) = mask(picture).expect("a picture");
            let target = size.map(|pixels| pixels * 2 / 5);
            let mean = |ink: &[u8]| ink.iter().map(|value| f32::from(*value)).sum::<f32>() / ink.len() as f32;
            let small = shrink(&ink, size, target);
            assert_eq!(small.len(), target[0] * target[1]);
            // Rounded to whole bytes.
            assert!((mean(&small) - mean(&ink)).abs() < 0.5, "{name}");
        }
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        assert_eq!(mask(&[0, 3, 0, 2, 0xf0, 0x04]), Some(([3, 2], vec![255, 0, 0, 0, 0, 0])));
        for bytes in [&[][..], &[0, 3, 0], &[0, 0, 0, 0], &[0, 3, 0, 2, 0xf0], &[0, 3, 0, 2, 0xf0, 0x05]] {
            assert_eq!(mask(bytes), None, "{bytes:?}");
        }
    }
}
