//! From a scene to a picture.

use crate::draw::Canvas;
use crate::error::Error;
use crate::options::{DepthFormat, RenderOptions};
use crate::scene::{Camera, Image, Model};
use alberti::{Band, D16, D24, F32, F32Reversed, NoDepth, Rgba8, Stats};

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
/// The camera has passed [`crate::camera::check`], the size is within its limits, and every index of the model is
/// within its arrays.
///
/// # Errors
/// The picture does not fit in memory, or the camera, the size or a texture cannot be drawn.
pub fn render(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Picture, Error> {
    let canvas = Canvas::new(model, camera, options)
        .map_err(|found| Error::new(found, "a camera, a size and textures that can be drawn"))?;
    let stats_and_pixels = match options.depth {
        DepthFormat::F32 => draw::<F32>(canvas, options, progress),
        DepthFormat::F32Reversed => draw::<F32Reversed>(canvas, options, progress),
        DepthFormat::U24 => draw::<D24>(canvas, options, progress),
        DepthFormat::U16 => draw::<D16>(canvas, options, progress),
        DepthFormat::None => draw::<NoDepth>(canvas, options, progress),
    };
    let (stats, texels) = stats_and_pixels?;
    Ok(Picture { image: Image { width: options.width, height: options.height, texels }, stats })
}

/// The picture with depth buffer `D`.
fn draw<D: alberti::DepthFormat>(
    canvas: Canvas<'_>,
    options: &RenderOptions,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<(Stats, Vec<[u8; 4]>), Error> {
    let mut pixels = buffer(options, 0)?;
    let mut depth = buffer(options, D::FARTHEST)?;
    let mut band = Band::<Rgba8, D>::new(options.width, 0, &mut pixels, &mut depth)
        .map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
    let stats = canvas.draw_all(&mut band, progress);
    drop(depth);
    let mut texels = buffer(options, [0; 4])?;
    for (texel, pixel) in texels.iter_mut().zip(pixels) {
        *texel = pixel.to_ne_bytes();
    }
    Ok((stats, texels))
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
