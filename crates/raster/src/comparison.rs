//! Other comparisons than "strictly nearer", and the mask that writes no depth: each wraps a format, and they can be
//! nested. `OrEqual(Farther(D16))` shows fragments as far or farther, `ReadOnly(OrEqual(F32))` draws decals.

use crate::depth::DepthFormat;
use alberti_math::lanes::Lanes;

/// Defines formats that store as `D` does, and differ in the items that are given.
macro_rules! like {
    ($($(#[$doc:meta])* $name:ident { $($different:item)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name<D>(
            /// The format.
            pub D,
        );

        impl<D: DepthFormat> DepthFormat for $name<D> {
            type Stored = D::Stored;
            const BIASED: bool = D::BIASED;

            #[inline]
            fn bias(self, slope: f32, greatest: f32) -> f32 {
                self.0.bias(slope, greatest)
            }

            #[inline]
            fn bias_steps(self, slope: u32, greatest: u32) -> i64 {
                self.0.bias_steps(slope, greatest)
            }

            #[inline(always)]
            fn reversed(self) -> bool {
                self.0.reversed()
            }

            #[inline(always)]
            fn farthest(self) -> D::Stored {
                self.0.farthest()
            }

            #[inline(always)]
            fn bits(self) -> u32 {
                self.0.bits()
            }

            #[inline]
            fn encode(self, zs: f32) -> D::Stored {
                self.0.encode(zs)
            }

            #[inline]
            fn encode_integer(self, zs: u32) -> D::Stored {
                self.0.encode_integer(zs)
            }

            #[inline(always)]
            fn encode_lanes<L: Lanes>(self, lanes: L, zs: L::Depth) -> L::Each<D::Stored> {
                self.0.encode_lanes(lanes, zs)
            }

            $($different)*
        }
    )*};
}

/// Defines formats that are seen where `D` would find the new depth nearer or farther in a certain way.
macro_rules! compared {
    ($($(#[$doc:meta])* $name:ident: |$nearer:ident, $farther:ident| $seen:expr;)*) => {
        like! {$(
            $(#[$doc])*
            ///
            /// # Cost
            /// As many comparisons, of none to two, as it takes to know that.
            $name {
                #[inline]
                fn nearer(self, new: D::Stored, old: D::Stored) -> bool {
                    let [$nearer, $farther] = [u32::from(self.0.nearer(new, old)), u32::from(self.0.nearer(old, new))];
                    $seen & 1 != 0
                }

                #[inline(always)]
                fn seen<L: Lanes>(
                    self,
                    lanes: L,
                    new: &L::Each<D::Stored>,
                    old: &L::Each<D::Stored>,
                    mask: L::Mask,
                ) -> L::Mask {
                    let [$nearer, $farther] = [self.0.seen(lanes, new, old, mask), self.0.seen(lanes, old, new, mask)];
                    let [$nearer, $farther] = [lanes.bits($nearer), lanes.bits($farther)];
                    lanes.mask(lanes.bits(mask) & $seen)
                }

                #[inline(always)]
                fn keep<L: Lanes>(
                    self,
                    lanes: L,
                    new: &L::Each<D::Stored>,
                    mask: L::Mask,
                    stored: &mut L::Each<D::Stored>,
                ) {
                    self.0.keep(lanes, new, mask, stored);
                }
            }
        )*}
    };
}

compared! {
    /// `D`, but a fragment as near as the stored depth is seen as well: of two equal ones, the last drawn stays.
    OrEqual: |nearer, farther| nearer | !farther;

    /// `D`, but only a fragment as near as the stored depth is seen: for passes that draw what was drawn before again,
    /// whose depths have the same bits.
    Equal: |nearer, farther| !(nearer | farther);

    /// `D`, but a fragment is seen if it is strictly farther than the stored depth: for backs of things, in a buffer
    /// that holds their fronts.
    Farther: |_nearer, farther| farther;

    /// `D`, written and never tested: what is drawn last hides all.
    Always: |_nearer, _farther| !0;
}

like! {
    /// `D`, tested and never written: what is drawn is hidden by what is nearer, and hides nothing.
    ///
    /// # Cost
    /// That of `D` without the store.
    ReadOnly {
        #[inline]
        fn nearer(self, new: D::Stored, old: D::Stored) -> bool {
            self.0.nearer(new, old)
        }

        #[inline(always)]
        fn seen<L: Lanes>(
            self,
            lanes: L,
            new: &L::Each<D::Stored>,
            old: &L::Each<D::Stored>,
            mask: L::Mask,
        ) -> L::Mask {
            self.0.seen(lanes, new, old, mask)
        }

        #[inline(always)]
        fn keep<L: Lanes>(self, _: L, _: &L::Each<D::Stored>, _: L::Mask, _: &mut L::Each<D::Stored>) {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AnyDepth, Cull, D16, D24, D32, Exact, F32, F32Reversed, Paint, Target, Vertex};
    use alberti_math::lanes::One;
    use alberti_math::{Fixed, Rgba8, Rgba8888, Sub8};
    use std::vec;

    /// Whether a format shows and stores a depth in front of, at and behind another.
    fn shown(format: impl DepthFormat<Stored: PartialEq>) -> [[bool; 2]; 3] {
        let (near, far) = if format.reversed() { (0.75, 0.25) } else { (0.25, 0.75) };
        [near, 0.5, far].map(|zs| {
            let (new, old) = ([format.encode(zs)], [format.encode(0.5)]);
            let seen = format.seen(One, &new, &old, true);
            assert_eq!(seen, format.nearer(new[0], old[0]), "{zs}");
            assert!(!format.seen(One, &new, &old, false), "a sample that is not asked for");
            let mut stored = [format.farthest()];
            format.keep(One, &new, seen, &mut stored);
            [seen, stored == new]
        })
    }

    fn comparisons(format: impl DepthFormat<Stored: PartialEq>) {
        let written = |shown: [bool; 3]| shown.map(|shown| [shown; 2]);
        assert_eq!(shown(format), written([true, false, false]));
        assert_eq!(shown(OrEqual(format)), written([true, true, false]));
        assert_eq!(shown(Equal(format)), written([false, true, false]));
        assert_eq!(shown(Farther(format)), written([false, false, true]));
        assert_eq!(shown(OrEqual(Farther(format))), written([false, true, true]));
        assert_eq!(shown(Always(format)), written([true; 3]));
        assert_eq!(shown(ReadOnly(format)), [[true, false], [false, false], [false, false]]);
    }

    #[test]
    fn each_shows_and_stores_what_it_says() {
        comparisons(D16);
        comparisons(D24);
        comparisons(D32);
        comparisons(F32);
        comparisons(F32Reversed);
        for format in [AnyDepth::D16, AnyDepth::D24, AnyDepth::D32, AnyDepth::F32, AnyDepth::F32Reversed] {
            comparisons(format);
        }
        assert_eq!(shown(AnyDepth::NoDepth).map(|[seen, _]| seen), [true; 3]);
    }

    /// Drawn again, in another order of its vertices and in a band of its own, a triangle has the same depths.
    #[test]
    fn a_triangle_is_equal_to_itself() {
        let at = |x: i32, y: i32, zs: f32, q: f32| Vertex {
            x: Fixed::from_subpixels(x).expect("small"),
            y: Fixed::from_subpixels(y).expect("small"),
            zs,
            q,
            varying: (),
        };
        let [a, b, c] = [at(130, 90, 0.1, 1.0), at(15_900, 700, 0.9, 0.1), at(3000, 10_111, 0.37, 0.6)];
        let (mut color, mut depth) = (vec![0u32; 64 * 48], vec![1f32; 64 * 48]);
        let mut whole = Target::new(Rgba8888, F32, 64, 48, &mut color, &mut depth).expect("64 by 48");
        let stage = |()| Some(Rgba8::WHITE);
        let white = Paint { stage, interpolation: Exact, subpixel: Sub8, cull: Cull::None };
        white.triangle(One, &mut whole, [&a, &b, &c], &mut ());

        let mut again = vec![0u32; 64 * 48];
        let rows = again.chunks_mut(64 * 17).zip(depth.chunks_mut(64 * 17));
        for (first_row, (color, depth)) in (0..).step_by(17).zip(rows) {
            let mut band =
                Target::band(Rgba8888, Equal(F32), [64, 48], first_row, color, depth).expect("rows");
            white.triangle(One, &mut band, [&c, &a, &b], &mut ());
        }
        assert!(again == color && color.iter().filter(|&&pixel| pixel != 0).count() > 500);
    }
}
