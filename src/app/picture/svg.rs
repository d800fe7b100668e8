//! Shapes as an SVG drawing: lines and letters stay what they are, so that any program can edit them.

use base64::{Engine as _, prelude::BASE64_STANDARD};
use eframe::egui::epaint::text::Glyph;
use eframe::egui::epaint::{ClippedShape, ColorMode, Mesh, PathStroke, RectShape, StrokeKind, TextShape, TextureId};
use eframe::egui::{Color32, ColorImage, Pos2, Rect, Shape, Stroke, Vec2};

use super::raster::{self, Textures};

/// The largest coordinate of a shape that is drawn, in points. No picture reaches farther.
const FARTHEST: f32 = 1e6;
/// How far a shape may reach out of its clip without being cut, in points. It looks the same.
const SLACK: f32 = 0.5;

/// Writes shapes as a drawing of this size, all in points. Coordinates have two decimals.
///
/// # Errors
/// Says why where an image in it cannot be written.
pub fn write(
    shapes: &[ClippedShape],
    size: Vec2,
    [title, description]: [&str; 2],
    textures: &Textures,
) -> Result<String, String> {
    let whole = Rect::from_min_size(Pos2::ZERO, size);
    let mut drawing = Drawing { out: String::new(), whole, textures, clips: Vec::new(), clip: None, lines: None };
    let [width, height] = [size.x, size.y].map(number);
    drawing.add(&[
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 ",
        &width,
        " ",
        &height,
        "\" width=\"",
        &width,
        "\" height=\"",
        &height,
        "\" font-family=\"'Noto Sans', Arial, sans-serif\" role=\"img\">\n<title>",
        &escaped(title),
        "</title>\n<desc>",
        &escaped(description),
        "</desc>\n",
    ]);
    for ClippedShape { clip_rect, shape, .. } in shapes {
        drawing.clipped(*clip_rect, shape)?;
    }
    drawing.cut(None);
    drawing.add(&["</svg>\n"]);
    Ok(drawing.out)
}

/// A number with two decimals at most.
fn number(value: f32) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// A text as it stands between two tags.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // XML has no way to write them.
            control if control.is_control() => out.push(' '),
            other => out.push(other),
        }
    }
    out
}

/// An attribute for a colour, with one for its opacity where it lets something through.
fn colour(attribute: &str, colour: Color32) -> String {
    let [r, g, b, a] = colour.to_srgba_unmultiplied();
    match a {
        0 => [" ", attribute, "=\"none\""].concat(),
        255 => format!(" {attribute}=\"#{r:02x}{g:02x}{b:02x}\""),
        _ => {
            let opacity = number(f32::from(a) / 255.0);
            format!(" {attribute}=\"#{r:02x}{g:02x}{b:02x}\" {attribute}-opacity=\"{opacity}\"")
        }
    }
}

/// The attributes of a line; nothing where there is none.
fn stroke(Stroke { width, color }: Stroke) -> String {
    if width <= 0.0 || color == Color32::TRANSPARENT {
        return String::new();
    }
    [&colour("stroke", color), " stroke-width=\"", &number(width), "\""].concat()
}

/// A path's line as one of a single colour.
fn plain(stroke: &PathStroke) -> Stroke {
    match stroke.color {
        ColorMode::Solid(colour) => Stroke::new(stroke.width, colour),
        ColorMode::UV(_) => Stroke::NONE,
    }
}

/// Lines from point to point, as a path has them.
fn way(points: &[Pos2], closed: bool) -> String {
    let mut out = String::new();
    for (i, point) in points.iter().enumerate() {
        out.push_str(if i == 0 { "M" } else { "L" });
        out.push_str(&number(point.x));
        out.push(' ');
        out.push_str(&number(point.y));
    }
    if closed {
        out.push('Z');
    }
    out
}

/// Whether all points are places on a drawing.
fn near(points: &[Pos2]) -> bool {
    points.iter().all(|point| point.x.abs() < FARTHEST && point.y.abs() < FARTHEST)
}

/// A drawing that is being written.
struct Drawing<'a> {
    out: String,
    whole: Rect,
    textures: &'a Textures,
    /// The clips there are, by their numbers.
    clips: Vec<Rect>,
    /// The clip of the group that is open.
    clip: Option<usize>,
    /// Lines with the same stroke that follow each other, such as dashes, become one path.
    lines: Option<(Stroke, String)>,
}

impl Drawing<'_> {
    fn add(&mut self, parts: &[&str]) {
        self.end_lines();
        self.out.push_str(&parts.concat());
    }

    /// Writes the lines that are still to be written.
    fn end_lines(&mut self) {
        if let Some((line, way)) = self.lines.take() {
            for part in ["<path fill=\"none\"", &stroke(line), " d=\"", &way, "\"/>\n"] {
                self.out.push_str(part);
            }
        }
    }

    /// What follows is cut at this clip, or nowhere.
    fn cut(&mut self, clip: Option<Rect>) {
        let known = clip.and_then(|clip| self.clips.iter().position(|known| *known == clip));
        if clip.is_some() == self.clip.is_some() && known == self.clip {
            return;
        }
        if self.clip.take().is_some() {
            self.add(&["</g>\n"]);
        }
        let Some(clip) = clip else { return };
        let index = known.unwrap_or(self.clips.len());
        let name = index.to_string();
        if known.is_none() {
            self.clips.push(clip);
            let place = place(clip);
            self.add(&["<clipPath id=\"c", &name, "\"><rect", &place, "/></clipPath>\n"]);
        }
        self.add(&["<g clip-path=\"url(#c", &name, ")\">\n"]);
        self.clip = Some(index);
    }

    fn clipped(&mut self, clip: Rect, shape: &Shape) -> Result<(), String> {
        if let Shape::Vec(shapes) = shape {
            return shapes.iter().try_for_each(|shape| self.clipped(clip, shape));
        }
        let clip = clip.intersect(self.whole);
        let bounds = shape.visual_bounding_rect();
        if !clip.is_positive() || !bounds.intersects(clip) {
            return Ok(());
        }
        self.cut((!clip.expand(SLACK).contains_rect(bounds)).then_some(clip));
        self.shape(shape)
    }

    fn shape(&mut self, shape: &Shape) -> Result<(), String> {
        match shape {
            Shape::Circle(circle) if near(&[circle.center]) => {
                let [x, y, radius] = [circle.center.x, circle.center.y, circle.radius].map(number);
                let look = [colour("fill", circle.fill), stroke(circle.stroke)].concat();
                self.add(&["<circle cx=\"", &x, "\" cy=\"", &y, "\" r=\"", &radius, "\"", &look, "/>\n"]);
            }
            Shape::LineSegment { points, stroke } => self.line(points, *stroke),
            Shape::Path(path) if path.fill == Color32::TRANSPARENT && !path.closed => {
                self.line(&path.points, plain(&path.stroke));
            }
            Shape::Path(path) => self.area(&path.points, path.closed, path.fill, plain(&path.stroke)),
            Shape::Rect(rect) => return self.rect(rect),
            Shape::Text(text) => self.text(text),
            Shape::Mesh(mesh) if mesh.texture_id == TextureId::default() => self.mesh(mesh),
            Shape::Mesh(mesh) => return self.image_of(mesh),
            // Nothing that is drawn here has other shapes.
            _ => {}
        }
        Ok(())
    }

    fn line(&mut self, points: &[Pos2], line: Stroke) {
        if points.len() < 2 || !near(points) || stroke(line).is_empty() {
            return;
        }
        let way = way(points, false);
        match &mut self.lines {
            Some((before, lines)) if *before == line => lines.push_str(&way),
            _ => {
                self.end_lines();
                self.lines = Some((line, way));
            }
        }
    }

    fn area(&mut self, points: &[Pos2], closed: bool, fill: Color32, line: Stroke) {
        if points.len() > 1 && near(points) {
            let look = [colour("fill", fill), stroke(line)].concat();
            self.add(&["<path", &look, " d=\"", &way(points, closed), "\"/>\n"]);
        }
    }

    fn rect(&mut self, shape: &RectShape) -> Result<(), String> {
        let rect = shape.rect;
        if !near(&[rect.min, rect.max]) {
            return Ok(());
        }
        if let Some(brush) = shape.brush.as_ref().filter(|brush| brush.fill_texture_id != TextureId::default()) {
            return self.image(brush.fill_texture_id, rect, brush.uv.min.y > brush.uv.max.y, shape.fill);
        }
        let half = match shape.stroke_kind {
            StrokeKind::Inside => -0.5,
            StrokeKind::Middle => 0.0,
            StrokeKind::Outside => 0.5,
        };
        let line = stroke(shape.stroke);
        let rect = if line.is_empty() { rect } else { rect.expand(half * shape.stroke.width) };
        let radius = shape.corner_radius.nw;
        let corners = if radius == 0 { String::new() } else { [" rx=\"", &radius.to_string(), "\""].concat() };
        let look = [place(rect), corners, colour("fill", shape.fill), line].concat();
        self.add(&["<rect", &look, &turn(shape.angle, rect.center()), "/>\n"]);
        Ok(())
    }

    fn text(&mut self, text: &TextShape) {
        if !near(&[text.pos]) {
            return;
        }
        let size = text.galley.job.sections.first().map_or(0.0, |section| section.format.font_id.size);
        let turn = turn(text.angle, text.pos);
        for placed in &text.galley.rows {
            let vertices = &placed.row.visuals.mesh.vertices;
            let shade = |glyph: &Glyph| {
                let own = vertices.get(glyph.first_vertex as usize).map_or(Color32::PLACEHOLDER, |vertex| vertex.color);
                let own = if own == Color32::PLACEHOLDER { text.fallback_color } else { own };
                text.override_text_color.unwrap_or(own).gamma_multiply(text.opacity_factor)
            };
            // Letters of one colour are one element.
            let visible = |glyph: &&Glyph| !glyph.chr.is_whitespace();
            let mut rest = placed.row.glyphs.as_slice();
            while let Some(start) = rest.iter().position(|glyph| visible(&glyph)) {
                rest = &rest[start..];
                let ink = shade(&rest[0]);
                let next = rest.iter().position(|glyph| visible(&glyph) && shade(glyph) != ink).unwrap_or(rest.len());
                let (run, others) = rest.split_at(next);
                rest = others;
                let Some(last) = run.iter().rfind(visible) else { continue };
                let (first, length) = (run[0].pos, last.pos.x + last.advance_width - run[0].pos.x);
                let at = text.pos + placed.pos.to_vec2() + first.to_vec2();
                let word: String = run.iter().map(|glyph| glyph.chr).collect();
                let [x, y, length, size] = [at.x, at.y, length, size].map(number);
                self.add(&["<text x=\"", &x, "\" y=\"", &y, "\" font-size=\"", &size, "\" textLength=\"", &length]);
                let look = [colour("fill", ink), turn.clone()].concat();
                self.add(&["\" lengthAdjust=\"spacingAndGlyphs\"", &look, ">", &escaped(word.trim_end()), "</text>\n"]);
            }
        }
    }

    /// Triangles, each of the mean colour of its corners. Those of one colour that follow each other are one path, so that
    /// no seams are seen between them.
    fn mesh(&mut self, mesh: &Mesh) {
        let mut path: Option<(Color32, String)> = None;
        for corners in mesh.indices.chunks_exact(3) {
            let corner = |i: usize| mesh.vertices.get(corners[i] as usize);
            let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) else { continue };
            let points = [a.pos, b.pos, c.pos];
            if !near(&points) {
                continue;
            }
            let mean = [0, 1, 2, 3].map(|i| {
                let sum: u16 = [a, b, c].iter().map(|corner| u16::from(corner.color.to_array()[i])).sum();
                u8::try_from(sum / 3).unwrap_or(u8::MAX)
            });
            let [r, g, b, a] = mean;
            let mean = Color32::from_rgba_premultiplied(r, g, b, a);
            match &mut path {
                Some((before, ways)) if *before == mean => ways.push_str(&way(&points, true)),
                _ => {
                    self.triangles(path.take());
                    path = Some((mean, way(&points, true)));
                }
            }
        }
        self.triangles(path);
    }

    fn triangles(&mut self, path: Option<(Color32, String)>) {
        if let Some((fill, ways)) = path.filter(|(fill, _)| *fill != Color32::TRANSPARENT) {
            self.add(&["<path shape-rendering=\"crispEdges\"", &colour("fill", fill), " d=\"", &ways, "\"/>\n"]);
        }
    }

    /// A rectangle with an image on it.
    fn image_of(&mut self, mesh: &Mesh) -> Result<(), String> {
        let Some(first) = mesh.vertices.first() else { return Ok(()) };
        let rect = mesh.calc_bounds();
        // Its first row is at the bottom where its upper corner has the end of the image.
        let upper = mesh.vertices.iter().find(|vertex| vertex.pos.y <= rect.min.y);
        let flipped = upper.is_some_and(|upper| upper.uv.y > 0.5);
        self.image(mesh.texture_id, rect, flipped, first.color)
    }

    fn image(&mut self, id: TextureId, rect: Rect, flipped: bool, tint: Color32) -> Result<(), String> {
        let Some(texture) = self.textures.get(id) else { return Ok(()) };
        if !near(&[rect.min, rect.max]) {
            return Ok(());
        }
        let [width, height] = texture.size;
        let mut pixels = Vec::with_capacity(width * height);
        for y in 0..height {
            let row = if flipped { height - 1 - y } else { y };
            pixels.extend((0..width).map(|x| texture[(x, row)]));
        }
        let data = BASE64_STANDARD.encode(raster::png(&ColorImage::new([width, height], pixels))?);
        let opacity = number(f32::from(tint.a()) / 255.0);
        self.add(&["<image", &place(rect), " preserveAspectRatio=\"none\" opacity=\"", &opacity, "\""]);
        self.add(&[" href=\"data:image/png;base64,", &data, "\"/>\n"]);
        Ok(())
    }
}

/// The attributes of a rectangle's place.
fn place(rect: Rect) -> String {
    let [x, y, width, height] = [rect.min.x, rect.min.y, rect.width(), rect.height()].map(number);
    [" x=\"", &x, "\" y=\"", &y, "\" width=\"", &width, "\" height=\"", &height, "\""].concat()
}

/// The attribute that turns something clockwise about a point by an angle in radians; nothing for none.
fn turn(angle: f32, about: Pos2) -> String {
    if angle == 0.0 {
        return String::new();
    }
    let [angle, x, y] = [angle.to_degrees(), about.x, about.y].map(number);
    [" transform=\"rotate(", &angle, " ", &x, " ", &y, ")\""].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(shapes: Vec<(Rect, Shape)>) -> String {
        let shapes: Vec<ClippedShape> =
            shapes.into_iter().map(|(clip, shape)| ClippedShape::new(clip, shape)).collect();
        write(&shapes, Vec2::new(100.0, 50.0), ["a < b", "c & d"], &Textures::default()).expect("a drawing")
    }

    #[test]
    fn numbers_have_two_decimals_at_most() {
        let numbers = [1.0, -0.001, 2.504, 100.0, -3.456, 0.1].map(number);
        assert_eq!(numbers, ["1", "0", "2.5", "100", "-3.46", "0.1"]);
    }

    #[test]
    fn shapes_become_elements_with_their_colours_and_dashes_one_path() {
        let everything = Rect::EVERYTHING;
        let red = Stroke::new(2.0, Color32::from_rgb(200, 10, 0));
        let dash = |x: f32| Shape::line_segment([Pos2::new(x, 1.0), Pos2::new(x + 2.0, 1.0)], red);
        let faint = Color32::from_rgba_unmultiplied(0, 0, 255, 51);
        let text = written(vec![
            (everything, dash(1.0)),
            (everything, dash(5.0)),
            (everything, Shape::circle_filled(Pos2::new(30.0, 20.0), 4.0, faint)),
        ]);
        assert!(text.contains("d=\"M1 1L3 1M5 1L7 1\""), "{text}");
        assert!(text.contains("stroke=\"#c80a00\" stroke-width=\"2\""), "{text}");
        assert!(text.contains("<circle cx=\"30\" cy=\"20\" r=\"4\" fill=\"#0000ff\" fill-opacity=\"0.2\"/>"), "{text}");
        assert!(text.contains("<title>a &lt; b</title>") && text.contains("<desc>c &amp; d</desc>"), "{text}");
    }

    /// Only what reaches out of its clip is cut, and what is no place or nowhere to be seen is left out.
    #[test]
    fn only_what_reaches_out_of_its_clip_is_cut() {
        let clip = Rect::from_min_max(Pos2::new(10.0, 10.0), Pos2::new(40.0, 40.0));
        let at = |x: f32| Shape::circle_filled(Pos2::new(x, 20.0), 3.0, Color32::RED);
        assert!(!written(vec![(clip, at(20.0))]).contains("clip"));
        let cut = written(vec![(clip, at(39.0)), (clip, at(11.0)), (clip, at(20.0)), (clip, at(90.0))]);
        assert_eq!((cut.matches("<clipPath").count(), cut.matches("<g ").count()), (1, 1), "{cut}");
        assert_eq!(cut.matches("<circle").count(), 3, "{cut}");
        let line = vec![Pos2::new(f32::NAN, 0.0), Pos2::new(5.0, 5.0), Pos2::new(1e9, 3.0)];
        let text = written(vec![(Rect::EVERYTHING, Shape::line(line, Stroke::new(1.0, Color32::RED)))]);
        assert!(!text.contains("NaN") && !text.contains("inf") && !text.contains("<path"), "{text}");
    }
}
