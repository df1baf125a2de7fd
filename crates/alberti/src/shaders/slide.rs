//! An image that a projector throws onto surfaces.

use super::wide::{pack, per_255, unpack};
use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, Varying};
use alberti_projection::Homogeneous;
use alberti_raster::{FragmentStage, Fragments, Gradient};
use alberti_texture::format::Storage;
use alberti_texture::{Clamp, Filter, Sampler, Size};

/// Another stage's colour with the image of a [`Projector`](crate::Projector) on it.
///
/// Vertices carry the place where the projector's image meets them, as
/// [`Projector::project`](crate::Projector::project) gives it, and the division is done at each fragment. Beside the
/// image and behind the projector the wrapped stage's colour stays as it is; things between the projector and a surface
/// throw no shadow. The image lies upright: its first row is at the top of the projector's pyramid, and its sides at
/// the pyramid's. It continues nowhere, but a filter may read beyond its border, hence [`Clamp`].
///
/// ```
/// use alberti::{glam::Vec3, shaders::*, texture::{Clamp, Nearest, Texture, format::Rgba8888}, *};
///
/// // Two texels, red on the left, from behind the right shoulder of someone who looks at a white wall.
/// let texels = [Rgba8::from_rgb24(0xff_00_00), Rgba8::from_rgb24(0x00_00_ff)].map(Rgba8::to_bytes);
/// let image = Texture::new(Rgba8888, &texels, 2, 1)?;
/// let at = |x, y, z| Point3::<World>::new(Vec3::new(x, y, z));
/// let place = look_at(at(2.0, 0.0, 6.0), at(0.0, 0.0, 0.0), Vector3::new(Vec3::Y))?;
/// let projector = Projector::new(place, 0.3, 2.0)?;
///
/// // The wall stands in the world where it was made, so that its points are the world's.
/// let wall = [Vec3::new(-9.0, -9.0, 0.0), Vec3::new(9.0, -9.0, 0.0), Vec3::new(0.0, 9.0, 0.0)];
/// let mesh = Mesh::new(&wall, &[[0u16, 1, 2]], |&p| (p, (projector.project(Point3::new(p)), ())));
/// let image = image.sampler(Nearest, Clamp);
/// let stage = Slide { surface: Solid(Rgba8::WHITE), image, mix: Mix::Modulate };
///
/// let (mut color, mut depth) = ([0; 64 * 48], [(); 64 * 48]);
/// let mut target = Target::new(Rgba8888, NoDepth, 64, 48, &mut color, &mut depth)?;
/// let view = Camera::look_at(Vec3::Z * 4.0, Vec3::ZERO, Vec3::Y)?.perspective(1.0, 0.1..10.0)?;
/// draw(&mut target, &view, &mesh, stage);
/// let shown = |column: usize, row: usize| color[64 * row + column].to_ne_bytes();
/// assert_eq!([shown(31, 24), shown(32, 24), shown(32, 8)], [texels[0], texels[1], [255; 4]]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Precision
/// The image's colour is that of the sampler at ((u/q + 1)/2, (v/q + 1)/2), each within 2ε (ε = 2^-24), for the u, v
/// and q that are interpolated. Whether there is an image follows from these exactly. A miss of up to e in each of u, v
/// and q becomes one of up to about 2e/q in u/q and v/q. The budget of [`Lines::bounded`](crate::Lines) is such an e,
/// so it does not cover the image, least of all close to the projector.
///
/// In fixed point u, v, q and the quotients are in steps of 2^-16, so that q should not be much below 1.
/// There, |u|, |v| and q may be up to 4096, to which they are clamped.
///
/// # Cost
/// Three components to interpolate; two divisions, and the sampler where there is an image.
#[derive(Clone, Copy, Debug)]
pub struct Slide<S, I> {
    /// The stage that the image falls on.
    pub surface: S,
    /// The image with its filter. Its alpha plays no part.
    pub image: I,
    /// The mixture of the image's colour and the surface's.
    pub mix: Mix,
}

/// A mixture of an image's colour and the surface's that it falls on, channel by channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Mix {
    /// The product of both, to the nearest byte: white leaves the surface as it is, black makes it black.
    #[default]
    Modulate,
    /// The sum of both, up to 255: black leaves the surface as it is, and it gets brighter elsewhere.
    Add,
}

impl Mix {
    /// A channel of the mixture, from 0 to 255 like the two.
    #[inline(always)]
    fn channel<L: Lanes>(self, lanes: L, surface: L::U32, image: L::U32) -> L::U32 {
        match self {
            Self::Modulate => per_255(lanes, surface * image),
            Self::Add => lanes.min_words(surface + image, lanes.word(255)),
        }
    }
}

impl<S, F: Storage, Fl: Filter, Z: Size> Slide<S, Sampler<'_, F, Fl, Clamp, Clamp, Z>> {
    /// Colours with the image on them, for the samples in `mask` whose places before the projector these are.
    #[inline(always)]
    pub fn on<L: Lanes>(&self, lanes: L, place: &[L::Number; 3], surface: L::U32, mask: L::Mask) -> L::U32 {
        let ([u, v], inside) = Homogeneous::divide_lanes(lanes, place);
        // Most surfaces see little of a projector.
        if lanes.bits(inside & mask) == 0 {
            return surface;
        }
        let half = lanes.splat(0.5);
        let image = self.image.sample_lanes(lanes, u * half + half, v * half + half);
        let ([r, g, b, a], [image_r, image_g, image_b, _]) = (unpack(lanes, surface), unpack(lanes, image));
        let mix = self.mix;
        let [r, g, b] =
            [mix.channel(lanes, r, image_r), mix.channel(lanes, g, image_g), mix.channel(lanes, b, image_b)];
        lanes.select_words(inside, pack(lanes, [r, g, b, a]), surface)
    }
}

impl<V, S, F, Fl, Z> FragmentStage<(Homogeneous, V)> for Slide<S, Sampler<'_, F, Fl, Clamp, Clamp, Z>>
where
    V: Varying,
    S: FragmentStage<V, Color = Rgba8>,
    F: Storage,
    Fl: Filter,
    Z: Size,
{
    as_surface!((Homogeneous, V), |gradient| &gradient.map(|(_, part)| part));

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, (Homogeneous, V)>) -> (L::U32, L::Mask) {
        let (surface, mask) = self.surface.shade(&fragments.part(|(_, varying)| *varying));
        (self.on(fragments.lanes, &fragments.varying.0, surface, mask), mask)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::Solid;
    use alberti_texture::format::Rgba8888;
    use alberti_texture::{Nearest, Texture};

    #[test]
    fn images_mix_with_the_surface_and_end_at_their_sides() {
        // Upper left, upper right; lower left, lower right.
        let texels = [[0, 0, 0, 0], [255, 255, 255, 0], [100, 50, 200, 0], [1, 2, 3, 0]];
        let image = Texture::new(Rgba8888, &texels, 2, 2).expect("2 x 2").sampler(Nearest, Clamp);
        let surface = Solid(Rgba8::new(200, 100, 50, 77));
        let shade = |u, v, q| {
            let varying = (Homogeneous { u, v, q }, ());
            let product =
                Slide { surface, image, mix: Mix::Modulate }.shade_one(varying).expect("never discards");
            let sum = Slide { surface, image, mix: Mix::Add }.shade_one(varying).expect("never discards");
            [product, sum].map(Rgba8::to_bytes)
        };
        let own = [200, 100, 50, 77];
        assert_eq!(shade(-0.5, 0.5, 1.0), [[0, 0, 0, 77], own]);
        assert_eq!(shade(0.5, 0.5, 1.0), [own, [255, 255, 255, 77]]);
        assert_eq!(shade(-2.0, -2.0, 2.5), [[78, 20, 39, 77], [255, 150, 250, 77]]);
        assert_eq!(shade(1.0, -1.0, 1.1), [[1, 1, 1, 77], [201, 102, 53, 77]]);
        // Beside it, on its border, behind the projector.
        for [u, v, q] in [[-1.5, 0.5, 1.0], [0.5, 1.0, 1.0], [0.5, 0.5, -1.0], [0.0, 0.0, 0.0]] {
            assert_eq!(shade(u, v, q), [own; 2]);
        }
    }
}
