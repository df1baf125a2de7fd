//! An image that a projector throws onto surfaces.

use super::{alone, pack, per_255, unpack};
use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, Varying};
use alberti_projection::Homogeneous;
use alberti_raster::{FragmentStage, Gradient};
use alberti_texture::format::Storage;
use alberti_texture::{Clamp, Filter, Sampler, Size};
use core::fmt::Debug;

/// Another stage's colour with the image of a [`Projector`](crate::Projector) on it.
///
/// Vertices carry where the projector's image meets them, as [`Projector::project`](crate::Projector::project) says,
/// and the division is done at each fragment. Beside the image and behind the projector the wrapped stage's colour
/// stays as it is; what stands between the projector and a surface throws no shadow. The image lies upright: its first
/// row is at the top of the projector's pyramid, and its sides at the pyramid's. It continues nowhere, but a filter may
/// read beyond its border, hence [`Clamp`].
///
/// ```
/// use alberti::{glam::Vec3, shaders::*, texture::{Clamp, Nearest, Texture}, *};
///
/// // Two texels, red on the left, from behind the right shoulder of someone who looks at a white wall.
/// let texels = [Rgba8::from_rgb24(0xff_00_00), Rgba8::from_rgb24(0x00_00_ff)].map(Rgba8::to_bytes);
/// let image = Texture::<Rgba8>::new(&texels, 2, 1)?;
/// let at = |x, y, z| Point3::<World>::new(Vec3::new(x, y, z));
/// let place = look_at(at(2.0, 0.0, 6.0), at(0.0, 0.0, 0.0), Vector3::new(Vec3::Y))?;
/// let projector = Projector::new(place, 0.3, 2.0)?;
///
/// let camera = look_at(at(0.0, 0.0, 4.0), at(0.0, 0.0, 0.0), Vector3::new(Vec3::Y))?;
/// let pass = Pass {
///     view: View {
///         to_eye: camera.inverse_orthonormal() * Frame::<Object, World>::IDENTITY,
///         projection: Perspective::new(1.0, 64.0 / 48.0, 0.1, 10.0)?,
///         viewport: Viewport::new(0, 0, 64, 48)?,
///     },
///     vertices: &[Vec3::new(-9.0, -9.0, 0.0), Vec3::new(9.0, -9.0, 0.0), Vec3::new(0.0, 9.0, 0.0)],
///     triangles: &[[0u16, 1, 2]],
///     // The model stands in the world where it was made, so that its points are the world's.
///     vertex_stage: |&p: &Vec3| (Point3::new(p), (projector.project(Point3::new(p)), ())),
///     fragment_stage: Slide {
///         surface: Solid(Rgba8::WHITE),
///         image: image.sampler::<Nearest, Clamp>(),
///         mix: Modulate,
///     },
///     cull: Cull::Back,
///     sides: Sides::GuardBand,
///     interpolation: Exact,
/// };
/// let (mut color, mut depth) = ([0; 64 * 48], [(); 64 * 48]);
/// let mut band = Band::<Rgba8, NoDepth>::new(64, 0, &mut color, &mut depth)?;
/// draw(&pass, &mut band, &mut [Slot::<Sub8, _>::EMPTY; 3], &mut ());
/// let shown = |column: usize, row: usize| color[64 * row + column].to_ne_bytes();
/// assert_eq!([shown(31, 24), shown(32, 24), shown(32, 8)], [texels[0], texels[1], [255; 4]]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Precision
/// The image's colour is that of the sampler at ((u/q + 1)/2, (v/q + 1)/2), each within 2ε, for the u, v and q that are
/// interpolated; whether there is an image follows from these exactly. A miss of up to e in each of u, v and q becomes
/// one of up to about 2e/q in u/q and v/q. The budget of [`Bounded`](crate::Bounded) is such an e, so it does not cover
/// the image, least of all close to the projector. In fixed point u, v, q and the quotients are in steps of 2^-16, so
/// that q should not be much below 1, and |u|, |v| and q may be up to 4096, to which they are clamped.
///
/// # Cost
/// Three components to interpolate; two divisions, and where there is an image what the sampler costs.
#[derive(Clone, Copy, Debug)]
pub struct Slide<S, I, M = Modulate> {
    /// What the image falls on.
    pub surface: S,
    /// The image with its filter. Its alpha plays no part.
    pub image: I,
    /// How the image's colour and the surface's become one.
    pub mix: M,
}

/// How an image's colour and the surface's that it falls on become one: [`Modulate`] or [`Add`], or one of yours.
pub trait Mix: Copy + Debug {
    /// A channel of the mixture, from 0 to 255 like the two.
    fn channel<L: Lanes>(self, lanes: L, surface: L::U32, image: L::U32) -> L::U32;
}

/// The product of both, to the nearest byte: white leaves the surface as it is, black makes it black.
#[derive(Clone, Copy, Debug, Default)]
pub struct Modulate;

impl Mix for Modulate {
    #[inline(always)]
    fn channel<L: Lanes>(self, lanes: L, surface: L::U32, image: L::U32) -> L::U32 {
        per_255(lanes, surface * image)
    }
}

/// The sum of both, up to 255: black leaves the surface as it is, and it gets brighter elsewhere.
#[derive(Clone, Copy, Debug, Default)]
pub struct Add;

impl Mix for Add {
    #[inline(always)]
    fn channel<L: Lanes>(self, lanes: L, surface: L::U32, image: L::U32) -> L::U32 {
        lanes.min_words(surface + image, lanes.word(255))
    }
}

impl<V, S, F, Fl, Z, M> FragmentStage<(Homogeneous, V)> for Slide<S, Sampler<'_, F, Fl, Clamp, Clamp, Z>, M>
where
    V: Varying,
    S: FragmentStage<V, Color = Rgba8>,
    F: Storage,
    Fl: Filter,
    Z: Size,
    M: Mix,
{
    type Color = Rgba8;
    type Derivatives = S::Derivatives;

    #[inline(always)]
    fn shade(&self, varying: (Homogeneous, V)) -> Option<Rgba8> {
        alone(self, varying)
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        (place, varyings): &([L::Number; 3], V::Of<L::Number>),
        gradient: &Gradient<([L::Number; 3], V::Of<L::Number>)>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        let gradient = gradient.map(|(_, of_surface)| of_surface);
        let (surface, mask) = self.surface.shade_lanes(lanes, varyings, &gradient, mask);
        let ([u, v], inside) = Homogeneous::divide_lanes(lanes, place);
        // Most surfaces see little of a projector.
        if lanes.bits(inside & mask) == 0 {
            return (surface, mask);
        }
        let half = lanes.splat(0.5);
        let image = self.image.sample_lanes(lanes, u * half + half, v * half + half);
        let ([r, g, b, a], [image_r, image_g, image_b, _]) = (unpack(lanes, surface), unpack(lanes, image));
        let mixed = [(r, image_r), (g, image_g), (b, image_b)].map(|(s, i)| self.mix.channel(lanes, s, i));
        let [r, g, b] = mixed;
        (lanes.select_words(inside, pack(lanes, [r, g, b, a]), surface), mask)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::Solid;
    use alberti_texture::{Nearest, Texture};

    #[test]
    fn images_mix_with_the_surface_and_end_at_their_sides() {
        // Upper left, upper right; lower left, lower right.
        let texels = [[0, 0, 0, 0], [255, 255, 255, 0], [100, 50, 200, 0], [1, 2, 3, 0]];
        let image = Texture::<Rgba8>::new(&texels, 2, 2).expect("2 x 2").sampler::<Nearest, Clamp>();
        let surface = Solid(Rgba8::new(200, 100, 50, 77));
        let shade = |u, v, q| {
            let varying = (Homogeneous { u, v, q }, ());
            let product = Slide { surface, image, mix: Modulate }.shade(varying).expect("never discards");
            let sum = Slide { surface, image, mix: Add }.shade(varying).expect("never discards");
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
