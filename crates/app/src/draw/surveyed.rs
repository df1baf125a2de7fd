//! A stage that writes down the surface that is seen instead of its colour, in the kernels that draw the pictures.

use super::clothed::Number;
use super::erased::Attributes;
use super::general::Surface;
use super::tapped::Tap;
use super::{Canvas, Drawing};
use alberti::glam::Vec3;
use alberti::lanes::{Lanes, One};
use alberti::raster::PerPixel;
use alberti::raster::color::AnyBlend;
use alberti::shaders::material::Framed;
use alberti::{FragmentStage, Fragments, Rgba8, Varying};

/// A number of the surface that is seen. All but counts are the bits of an `f32`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Known {
    /// The running number of the triangle over all parts, and 1; 0 where nothing is seen.
    Triangle,
    /// Texture coordinates.
    U,
    /// The other one.
    V,
    /// The level of detail, or NaN for a surface without a texture.
    Lod,
    /// The unit normal in world space, after all maps.
    X,
    /// Its second coordinate.
    Y,
    /// Its third coordinate.
    Z,
    /// The distance before the camera's plane.
    Depth,
}

/// How many there are.
pub(crate) const KNOWN: usize = Known::Depth as usize + 1;

impl From<Known> for usize {
    fn from(known: Known) -> Self {
        known as Self
    }
}

/// The least alpha of surfaces that hide more than they let through.
const HIDING: u8 = 128;

/// The stage: each fragment is handed on alone, and kept if the answer is yes.
#[derive(Clone, Copy)]
struct Surveyed<'a> {
    write: &'a (dyn Fn(&Fragments<One, Attributes>) -> bool + Sync),
}

impl FragmentStage<Attributes> for Surveyed<'_> {
    type Color = Rgba8;
    type Derivatives = PerPixel;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Attributes>) -> (L::U32, L::Mask) {
        let &Fragments { lanes, varying, gradient, mask, place: [column, row] } = fragments;
        let (samples, mut kept) = (lanes.bits(mask), 0);
        for (k, column) in (0..L::COUNT).zip(column..).filter(|(k, _)| samples >> k & 1 != 0) {
            let alone = |number| lanes.store(number).as_ref().get(k).copied().unwrap_or_default();
            let all = |bundle| Attributes::map(&bundle, &alone);
            let (varying, gradient) = (all(varying), gradient.map(all));
            let fragment = Fragments { lanes: One, varying, gradient, mask: true, place: [column, row] };
            kept |= u32::from((self.write)(&fragment)) << k;
        }
        (lanes.word(0), mask & lanes.mask(kept))
    }
}

impl Drawing<'_> {
    /// Draws the whole model into a cleared target, and writes down the surfaces that are seen.
    ///
    /// Holes are left out, and surfaces that are mixed with what is behind them where they hide less than half of it.
    pub(crate) fn survey(&self, tap: &Tap<KNOWN>, target: &mut Canvas<'_>) {
        let (eye, forward) = (self.camera.origin().coords.as_dvec3(), self.camera.axes().z_axis.as_dvec3());
        let clothe = |part: &_| self.clothed_whole(part).0;
        self.each_chunk_clothed(clothe, true, |part, mesh| {
            let (_, mut shown) = self.clothed_whole(part);
            let Surface::ByFragment(material) = shown.surface else { return };
            match part.detail.blend {
                AnyBlend::Replace => {}
                AnyBlend::Constant(alpha) if alpha >= HIDING => {}
                AnyBlend::Over | AnyBlend::Premultiplied => shown.least = shown.least.max(HIDING),
                _ => return,
            }
            let texture = part.texture.and_then(|texture| self.textures.get(texture));
            let size = texture.map(|texture| [texture.width(), texture.height()]);
            let write = |fragment: &Fragments<One, Attributes>| {
                if shown.least > 0 && !shown.shade(fragment).1 {
                    return false;
                }
                let ([low, high, _], seen) = fragment.varying;
                let half = |number| One.store_words(One.floor_scaled(number, Number::BITS))[0];
                let number = Number::of([half(low), half(high)]);
                let framed = fragment.part::<Framed>(|(_, framed)| *framed);
                let [x, y, z] = material.surface(&framed).normal;
                let lod = size.map(|size| framed.gradient.map(|framed| framed.uv).lod_lanes(One, size));
                let from_eye = Vec3::from_array(seen.position).as_dvec3() - eye;
                #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
                let depth = from_eye.dot(forward) as f32;
                let ([u, v], lod) = (seen.uv, lod.unwrap_or(f32::NAN));
                tap.write(fragment.place, Known::Triangle, number + 1);
                for (known, value) in [
                    (Known::U, u),
                    (Known::V, v),
                    (Known::Lod, lod),
                    (Known::X, x),
                    (Known::Y, y),
                    (Known::Z, z),
                    (Known::Depth, depth),
                ] {
                    tap.write(fragment.place, known, value.to_bits());
                }
                true
            };
            let _ = self.by_policies(mesh, Surveyed { write: &write }, AnyBlend::Replace, target);
        });
    }
}
