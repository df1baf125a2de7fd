//! Depths that are written or only tested, as is known at run time.

use alberti::lanes::Lanes;
use alberti::{AnyDepth, DepthFormat};

type Stored = <AnyDepth as DepthFormat>::Stored;

/// The depths of [`AnyDepth`], and whether they are written: [`ReadOnly`](alberti::ReadOnly), chosen at run time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kept {
    pub(super) format: AnyDepth,
    pub(super) written: bool,
}

impl DepthFormat for Kept {
    type Stored = Stored;

    #[inline(always)]
    fn reversed(self) -> bool {
        self.format.reversed()
    }

    #[inline(always)]
    fn farthest(self) -> Stored {
        self.format.farthest()
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        self.format.bits()
    }

    #[inline]
    fn encode(self, zs: f32) -> Stored {
        self.format.encode(zs)
    }

    #[inline]
    fn encode_integer(self, zs: u32) -> Stored {
        self.format.encode_integer(zs)
    }

    #[inline(always)]
    fn encode_lanes<L: Lanes>(self, lanes: L, zs: L::Depth) -> L::Each<Stored> {
        self.format.encode_lanes(lanes, zs)
    }

    #[inline]
    fn nearer(self, new: Stored, old: Stored) -> bool {
        self.format.nearer(new, old)
    }

    #[inline(always)]
    fn seen<L: Lanes>(
        self,
        lanes: L,
        new: &L::Each<Stored>,
        old: &L::Each<Stored>,
        mask: L::Mask,
    ) -> L::Mask {
        self.format.seen(lanes, new, old, mask)
    }

    #[inline(always)]
    fn keep<L: Lanes>(self, lanes: L, new: &L::Each<Stored>, mask: L::Mask, stored: &mut L::Each<Stored>) {
        if self.written {
            self.format.keep(lanes, new, mask, stored);
        }
    }
}
