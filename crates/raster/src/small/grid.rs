//! The grids on which small triangles may be.

/// The grid of a triangle's corners, as far as it is known when compiling.
pub trait Grid: Copy {
    /// Whether it is that of `Sub8`, not of `Sub4`.
    fn is_fine(self) -> bool;

    /// Bits of its subpixels.
    #[inline(always)]
    fn bits(self) -> u32 {
        if self.is_fine() { 8 } else { 4 }
    }
}

/// The grid of coarse triangles.
#[derive(Clone, Copy)]
pub(crate) struct Coarse;

/// The grid of fine ones.
#[derive(Clone, Copy)]
pub(crate) struct Fine;

/// Either grid, by the value: one kernel for both, for less code.
#[derive(Clone, Copy)]
pub(crate) struct Either {
    pub(crate) fine: bool,
}

impl Grid for Coarse {
    #[inline(always)]
    fn is_fine(self) -> bool {
        false
    }
}

impl Grid for Fine {
    #[inline(always)]
    fn is_fine(self) -> bool {
        true
    }
}

impl Grid for Either {
    #[inline(always)]
    fn is_fine(self) -> bool {
        self.fine
    }
}
