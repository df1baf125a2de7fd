//! The journey of one pixel: from the triangle that is seen there to the word that is stored, step by step.
//!
//! The fragments are drawn by the pipeline's own code, one lane wide, triangle by triangle, and their numbers are kept
//! on the way (`draw/traced.rs`). The steps before them are taken again by the library's public functions, and set
//! beside the same relations in `f64`. In the end the colour is compared with that of the whole picture.

mod attributes;
mod nothing;
mod report;
mod screen;
mod shape;
mod space;
mod surface;
#[cfg(test)]
mod tests;
mod theory;

use crate::display::{Stored, stored};
use crate::draw::{Arrival, Drawing, Piece, Studio, Traced};
use crate::error::{Error, quote};
use crate::options::values::name_of;
use crate::options::{DepthFormat, Dither, RenderOptions};
use crate::render::{any_depth, render};
use crate::scene::{Camera, Model, Part};
use alberti::raster::color::AnyBlend;
use alberti::{AnyProjection, Frame, Object, Rgba8, Viewport};
use report::{Block, Cell};
use serde_json::{Map, Value, json};
use shape::Shape;

/// An explained pixel.
#[derive(Clone, Debug)]
pub struct Journey {
    pixel: [u32; 2],
    size: [u32; 2],
    covered: bool,
    agrees: bool,
    blocks: Vec<Block>,
}

/// All that steps are taken with.
struct Scene<'a> {
    drawing: &'a Drawing<'a>,
    camera: &'a Camera,
    options: &'a RenderOptions,
    pixel: [u32; 2],
    viewport: Viewport,
    projection: AnyProjection,
    to_eye: Frame<Object, alberti::Eye>,
}

/// The fragment that is explained.
struct Fragment<'a> {
    arrival: &'a Arrival,
    part: &'a Part,
    /// The triangle's vertices in object space.
    vertices: [crate::scene::Vertex; 3],
    indices: [u32; 3],
    /// That of the model.
    origin: [f64; 3],
    /// Its parts on the screen, and the number of the one that covers the pixel.
    pieces: Vec<Piece>,
    number: usize,
    shape: Shape,
}

/// Explains a pixel of the picture that [`render`] draws of the same.
///
/// # Errors
/// A pixel outside the picture, or of a surface that is seen through, and those of [`render`].
pub fn explain(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    pixel: [u32; 2],
) -> Result<Journey, Error> {
    let ([x, y], RenderOptions { width, height, .. }) = (pixel, *options);
    if x >= width || y >= height {
        let expected = format!("one of a picture of {width}x{height}: 0,0 to {},{}", width - 1, height - 1);
        return Err(Error::new(format!("the pixel {x},{y}"), expected).place("--pixel"));
    }
    check(options)?;
    let journeys = explain_each(model, camera, options, &[pixel])?;
    journeys.into_iter().next().ok_or_else(|| Error::new("no journey", "one for the pixel"))
}

/// # Errors
/// Something that comes after a fragment's colour, where a journey ends.
fn check(options: &RenderOptions) -> Result<(), Error> {
    let refused = |found: String, option: &str| {
        let hint = "explain ends at the surface's colour";
        Err(Error::new(found, "a picture without").place(option.to_owned()).hint(hint))
    };
    if options.haze.is_some() {
        return refused("a fog".to_owned(), "--fog");
    }
    if options.policies.dither != Dither::None {
        return refused("a pattern".to_owned(), "--dither");
    }
    Ok(())
}

/// # Errors
/// The pixel shows something that is mixed with what is behind it, or has holes.
fn check_opaque(model: &Model, traced: &Traced) -> Result<(), Error> {
    let part = |arrival: &Arrival| model.parts.get(arrival.part);
    let seen: Vec<_> = traced.arrivals.iter().filter(|arrival| arrival.seen).collect();
    let is_open = |arrival: &&&Arrival| part(arrival).is_some_and(|part| part.detail.is_seen_through());
    let Some(open) = seen.iter().rfind(is_open) else { return Ok(()) };
    let named = |arrival: &Arrival| {
        let name = part(arrival).map(|part| part.name.as_str()).filter(|name| !name.is_empty());
        let of = name.map(|name| format!(" of {}", quote(name.as_bytes()))).unwrap_or_default();
        format!("triangle {}{of}", arrival.triangle)
    };
    let how = match part(open).map(|part| (part.detail.blend, part.detail.alpha_test)) {
        Some((AnyBlend::Constant(alpha), _)) => {
            format!("that is blended with an alpha of {:.3}", f64::from(alpha) / 255.0)
        }
        Some((AnyBlend::Replace, _)) => "that has holes".to_owned(),
        _ => "that is blended".to_owned(),
    };
    let opaque = seen.iter().rfind(|arrival| !is_open(arrival));
    let behind = opaque.map_or_else(|| "the background".to_owned(), |arrival| named(arrival));
    let found = format!("{} {how}, before {behind}", named(open));
    let error = Error::new(found, "a pixel of opaque surfaces").place("--pixel");
    Err(error.hint("explain ends at the surface's colour: choose another pixel"))
}

/// The same of several pixels of one picture, all of them within it.
fn explain_each(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    pixels: &[[u32; 2]],
) -> Result<Vec<Journey>, Error> {
    options.policies.check()?;
    let studio = Studio::new(model, camera, options)?;
    let drawing = Drawing::new(model, camera, options, &studio)?;
    let RenderOptions { width, height, .. } = *options;
    let viewport = Viewport::new(0, 0, width, height)
        .map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
    let view = drawing.view();
    let (projection, to_eye) = (view.projection(&viewport), view.object_to_eye(None));
    let picture = render(model, camera, options, &mut |_, _| ())?.image;
    let of = |&pixel: &[u32; 2]| {
        let scene = Scene { drawing: &drawing, camera, options, pixel, viewport, projection, to_eye };
        let [x, y] = pixel.map(|at| at as usize);
        let found = picture.texels.get(y * width as usize + x).copied().unwrap_or_default();
        scene.journey(model, found)
    };
    pixels.iter().map(of).collect()
}

impl Journey {
    /// Whether something covers the pixel.
    #[must_use]
    pub fn is_covered(&self) -> bool {
        self.covered
    }

    /// Whether the colour that was derived is that of the picture.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.agrees
    }

    /// For people.
    #[must_use]
    pub fn text(&self) -> String {
        let ([x, y], [width, height]) = (self.pixel, self.size);
        let numbers = self.blocks.iter().scan(0, |steps, block| {
            *steps += u32::from(block.is_step());
            Some(block.is_step().then_some(*steps))
        });
        let blocks: Vec<String> = self.blocks.iter().zip(numbers).map(|(block, n)| block.text(n)).collect();
        format!(
            "pixel {x},{y} of {width}x{height}; relations are those of docs/theory.md\n\n{}",
            blocks.join("\n")
        )
    }

    /// For programs: an object with a key for each step.
    #[must_use]
    pub fn json(&self) -> Value {
        let mut object = Map::new();
        object.insert("pixel".to_owned(), json!(self.pixel));
        object.insert("size".to_owned(), json!(self.size));
        object.insert("covered".to_owned(), json!(self.covered));
        object.insert("agrees".to_owned(), json!(self.agrees));
        for block in &self.blocks {
            object.insert(block.key.to_owned(), block.json());
        }
        Value::Object(object)
    }
}

impl Scene<'_> {
    /// The journey, at the end of which the picture has the colour `found`.
    fn journey(&self, model: &Model, found: [u8; 4]) -> Result<Journey, Error> {
        let options = self.options;
        let traced = self.drawing.trace(self.pixel, self.drawing.cull())?;
        check_opaque(model, &traced)?;
        let mut blocks = vec![self.policies(), self.fragments(model, &traced)];
        let seen = traced.arrivals.iter().rfind(|arrival| arrival.seen);
        let fragment = seen.and_then(|arrival| self.fragment(model, arrival));
        let [r, g, b] = options.background;
        let mut color = Rgba8::new(r, g, b, 255);
        match &fragment {
            Some(fragment) => {
                blocks.extend(self.in_space(fragment));
                blocks.extend(self.on_screen(fragment));
                blocks.extend(self.attributes(fragment));
                if let Some(look) = self.drawing.look(fragment.arrival, self.pixel) {
                    blocks.extend(self.on_surface(fragment, &look));
                    color = look.color;
                }
            }
            None => blocks.push(self.nothing(model, &traced)?),
        }
        let derived = stored(&options.policies, self.place(), color.to_bytes()).color;
        let agrees = derived == found && seen.is_some() == fragment.is_some();
        blocks.push(self.stored(color, found, agrees));
        let size = [options.width, options.height];
        Ok(Journey { pixel: self.pixel, size, covered: fragment.is_some(), agrees, blocks })
    }

    /// The policies under which all that follows holds.
    fn policies(&self) -> Block {
        let options = self.options;
        let policies = options.policies;
        let mut block = Block::new("policies", "policies", &[]);
        block.value("interpolation", "interpolation", policies.interpolation.to_string());
        block.value("arithmetic", "arithmetic", name_of(policies.arithmetic));
        block.value("subpixel_bits", "subpixel bits", self.drawing.subpixel().bits());
        block.value("depth", "depth", name_of(options.depth));
        block.value("color", "colour", name_of(policies.color));
        block.value("shading", "shading", name_of(options.shading));
        block.value("cull", "left out", name_of(options.cull));
        block
    }

    /// The fragments that came to the pixel.
    fn fragments(&self, model: &Model, traced: &Traced) -> Block {
        let mut block = Block::new("fragments", "fragments, in drawing order", &[theory::Z_BUFFER]);
        if traced.arrivals.is_empty() {
            block.note("none", "no triangle covers the pixel");
            return block;
        }
        let row = |(number, arrival): (usize, &Arrival)| {
            let test = match (self.options.depth, arrival.seen) {
                (DepthFormat::None, _) => "seen: no depths are compared",
                (_, true) if arrival.before == self.farthest() => "seen: the buffer was clear",
                (_, true) => "seen: nearer than what is stored",
                (_, false) => "hidden: not nearer than what is stored",
            };
            let name = model.parts.get(arrival.part).map(|part| part.name.clone()).unwrap_or_default();
            vec![
                number.into(),
                arrival.part.into(),
                arrival.triangle.into(),
                self.zs(arrival.zs),
                self.word(arrival.depth),
                self.word(arrival.before),
                name.into(),
                test.into(),
            ]
        };
        let columns = ["", "part", "triangle", "zs", "word", "stored before", "name", "test"];
        let columns = columns.map(|name| if name.is_empty() { "number" } else { name });
        block.table("arrived", &columns, traced.arrivals.iter().enumerate().map(row).collect());
        if let Some(last) = traced.arrivals.iter().rposition(|arrival| arrival.seen) {
            block.value("explained", "explained is number", last);
        }
        block
    }

    /// The fragment, if the pieces of its triangle agree that there is one.
    fn fragment<'a>(&self, model: &'a Model, arrival: &'a Arrival) -> Option<Fragment<'a>> {
        let part = model.parts.get(arrival.part)?;
        let indices = *part.triangles.get(arrival.triangle)?;
        let [a, b, c] = indices.map(|index| model.vertices.get(index as usize).copied());
        let pieces = self.drawing.pieces(part, arrival.triangle);
        let shapes = pieces.iter().map(|piece| Shape::new(piece, self.pixel, self.drawing.subpixel()));
        let (number, shape) = shapes.enumerate().find(|(_, shape)| shape.covers())?;
        let (vertices, origin) = ([a?, b?, c?], model.origin);
        Some(Fragment { arrival, part, vertices, indices, origin, pieces, number, shape })
    }

    /// zs as it was interpolated.
    fn zs(&self, bits: u32) -> Cell {
        if self.is_fixed() { (f64::from(bits) / 4_294_967_296.0).into() } else { f32::from_bits(bits).into() }
    }

    /// A word of the depth buffer in the format's own form.
    fn word(&self, word: u32) -> Cell {
        match self.options.depth {
            DepthFormat::None => Cell::None,
            // Kept upside down where the format is chosen at run time.
            DepthFormat::F32Reversed => Cell::Word(!word),
            _ => Cell::Word(word),
        }
    }

    fn farthest(&self) -> u32 {
        alberti::DepthFormat::farthest(any_depth(self.options.depth))
    }

    /// The pixel's column and row.
    fn place(&self) -> [i32; 2] {
        self.pixel.map(u32::cast_signed)
    }

    fn is_fixed(&self) -> bool {
        self.options.policies.arithmetic == crate::options::Arithmetic::Fixed
    }

    /// The colour, the word, and whether it is that of the picture.
    fn stored(&self, color: Rgba8, found: [u8; 4], agrees: bool) -> Block {
        let mut block = Block::new("stored", "stored", &[]);
        let Stored { word, digits, color: seen } =
            stored(&self.options.policies, self.place(), color.to_bytes());
        block.values("color", "colour", color.to_bytes().map(u32::from));
        block.value("word", "word (r, g, b, a from the left)", format!("0x{word:0digits$x}"));
        block.values("shown", "seen as", seen.map(u32::from));
        block.values("picture", "a picture of one sample has", found.map(u32::from));
        let verdict = if agrees {
            "the derived colour is that of the picture with one sample a pixel, to the bit"
        } else {
            "DEFECT: the derived colour is not that of the picture; please report it"
        };
        block.note("verdict", verdict);
        block
    }
}
