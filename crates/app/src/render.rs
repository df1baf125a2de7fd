//! From a scene to a picture.

use crate::draw::{Canvas, DrawPart, Studio};
use crate::error::Error;
use crate::options::{ColorFormat, DepthFormat, RenderOptions};
use crate::scene::{Camera, Image, Model};
use alberti::raster::rgb565;
use alberti::texture::{TexelFormat as _, format::Rgb565};
use alberti::{Band, D16, D24, D32, F32, F32Reversed, NoDepth, Rgba8, Stats};

/// A finished picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Opaque; rows from the top.
    pub image: Image,
    /// What happened.
    pub stats: Stats,
}

/// Draws the model. `progress` hears (triangles done, all triangles).
///
/// The camera is as [`crate::camera::frame`] makes them, the size is within its limits, and every index of the model is
/// within its arrays.
///
/// # Errors
/// The policies do not go together, the picture does not fit in memory, or the camera, the size or a texture cannot be
/// drawn.
pub fn render(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Picture, Error> {
    options.policies.check()?;
    let studio = Studio::new(model, camera, options)?;
    let canvas = Canvas::new(model, camera, options, &studio)?;
    // Each format with kernels for each stage takes a minute to compile.
    let stats_and_pixels = match options.depth {
        DepthFormat::F32 => draw::<F32>(canvas, Canvas::by_default, options, progress),
        DepthFormat::F32Reversed => draw::<F32Reversed>(canvas, Canvas::by_default, options, progress),
        DepthFormat::U32 => draw::<D32>(canvas, Canvas::in_general, options, progress),
        DepthFormat::U24 => draw::<D24>(canvas, Canvas::in_general, options, progress),
        DepthFormat::U16 => draw::<D16>(canvas, Canvas::in_general, options, progress),
        DepthFormat::None => draw::<NoDepth>(canvas, Canvas::in_general, options, progress),
    };
    let (stats, texels) = stats_and_pixels?;
    Ok(Picture { image: Image { width: options.width, height: options.height, texels }, stats })
}

/// The picture with depth buffer `D`.
fn draw<'a, D: alberti::DepthFormat>(
    canvas: Canvas<'a>,
    draw_part: DrawPart<'a, D>,
    options: &RenderOptions,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<(Stats, Vec<[u8; 4]>), Error> {
    let mut pixels = buffer(options, 0)?;
    let mut depth = buffer(options, D::FARTHEST)?;
    let mut band = Band::<Rgba8, D>::new(options.width, 0, &mut pixels, &mut depth)
        .map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
    let stats = canvas.draw_all(draw_part, &mut band, progress);
    drop(depth);
    let mut texels = buffer(options, [0; 4])?;
    for (texel, pixel) in texels.iter_mut().zip(pixels) {
        *texel = shown(options.policies.color, pixel.to_ne_bytes());
    }
    Ok((stats, texels))
}

/// What is to be seen of a colour where pixels are stored in this format.
///
/// Nothing that is drawn reads a colour back, so the last one to be stored is all that counts, and to round it
/// afterwards gives the pixels that a buffer of that format would hold.
fn shown(format: ColorFormat, [r, g, b, a]: [u8; 4]) -> [u8; 4] {
    match format {
        ColorFormat::Rgba8 => [r, g, b, a],
        ColorFormat::Rgb565 => Rgb565::decode(rgb565(Rgba8::new(r, g, b, a))).to_bytes(),
    }
}

/// One element a pixel, or an error instead of an abort where memory is short.
fn buffer<T: Copy>(options: &RenderOptions, value: T) -> Result<Vec<T>, Error> {
    let pixels = options.width as usize * options.height as usize;
    let mut buffer = Vec::new();
    buffer.try_reserve_exact(pixels).map_err(|_| {
        let found = format!("too little memory for {}x{} pixels", options.width, options.height);
        Error::new(found, format!("{} MiB", (pixels * size_of::<T>()) >> 20))
            .place("--size")
            .hint("choose a smaller size")
    })?;
    buffer.resize(pixels, value);
    Ok(buffer)
}
