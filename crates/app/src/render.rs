//! From a scene to a picture.

use crate::display::stored;
use crate::draw::{Drawing, Studio};
use crate::error::Error;
use crate::options::{DepthFormat, RenderOptions};
use crate::scene::{Camera, Image, Model};
use alberti::{AnyDepth, DepthFormat as _, Rgba8888, Stats, Target};

/// A finished picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Opaque; rows from the top.
    pub image: Image,
    /// Counts of the drawing.
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
    let mut pixels = buffer(options, 0)?;
    let depth_format = any_depth(options.depth);
    let mut depth = buffer(options, depth_format.farthest())?;
    let RenderOptions { width, height, .. } = *options;
    let mut target = Target::new(Rgba8888, depth_format, width, height, &mut pixels, &mut depth)
        .map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
    let stats = draw(model, camera, options, &mut target, progress)?;
    drop(depth);
    let mut texels = buffer(options, [0; 4])?;
    let rows = texels.chunks_mut(width as usize).zip(pixels.chunks(width as usize));
    for ((texels, pixels), row) in rows.zip(0..) {
        for ((texel, pixel), column) in texels.iter_mut().zip(pixels).zip(0..) {
            *texel = stored(&options.policies, [column, row], pixel.to_ne_bytes()).color;
        }
    }
    Ok(Picture { image: Image { width, height, texels }, stats })
}

/// [`render`] into memory of the caller's, which is cleared before: 8 bits a channel, whatever the options' format is.
/// The depth format is the target's.
///
/// # Errors
/// Those of [`render`], but for memory.
pub fn draw(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    target: &mut Target<'_, Rgba8888, AnyDepth>,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Stats, Error> {
    options.policies.check()?;
    let studio = Studio::new(model, camera, options)?;
    let drawing = Drawing::new(model, camera, options, &studio)?;
    Ok(drawing.draw_all(target, progress))
}

/// The library's depth format of that name.
#[must_use]
pub fn any_depth(depth: DepthFormat) -> AnyDepth {
    match depth {
        DepthFormat::F32 => AnyDepth::F32,
        DepthFormat::F32Reversed => AnyDepth::F32Reversed,
        DepthFormat::U32 => AnyDepth::D32,
        DepthFormat::U24 => AnyDepth::D24,
        DepthFormat::U16 => AnyDepth::D16,
        DepthFormat::None => AnyDepth::NoDepth,
    }
}

/// One element a pixel, or an error instead of an abort where memory is short.
pub(crate) fn buffer<T: Copy>(options: &RenderOptions, value: T) -> Result<Vec<T>, Error> {
    room(options, options.width as usize * options.height as usize, value)
}

/// So many elements for a picture, or an error instead of an abort where memory is short.
pub(crate) fn room<T: Copy>(options: &RenderOptions, count: usize, value: T) -> Result<Vec<T>, Error> {
    let mut buffer = Vec::new();
    buffer.try_reserve_exact(count).map_err(|_| {
        let found = format!("too little memory for {}x{} pixels", options.width, options.height);
        Error::new(found, format!("{} MiB", (count * size_of::<T>()) >> 20))
            .place("--size")
            .hint("choose a smaller size")
    })?;
    buffer.resize(count, value);
    Ok(buffer)
}
