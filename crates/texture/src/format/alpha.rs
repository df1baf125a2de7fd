//! Texels that one product mixes with pixels of RGB565.

use super::TexelFormat;
use alberti_math::{Rgba8, Rgba565};

/// Words of [`Rgba565`]: colours of 16 bits with alpha, multiplied by it, for what is drawn over RGB565 on small cores.
///
/// ```
/// use alberti_math::Rgba8;
/// use alberti_texture::{Nearest, Repeat, Texture, format::Rgb565Alpha};
///
/// // Half of red, and nothing, as part of a program.
/// static TEXELS: [u32; 2] = Rgb565Alpha::of(&[[255, 0, 0, 128], [0; 4]]);
/// let texture = Texture::new(Rgb565Alpha, &TEXELS, 2, 1)?;
/// assert_eq!(texture.texel(0, 0).to_bytes(), [255, 0, 0, 128]);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
///
/// # Precision
/// Alpha has 33 levels. Colours have the fewer the less alpha there is: none, and so black, where it is 3 and less.
/// Levels of a mip map are therefore built in another format and encoded then, as `alberti bake` does.
///
/// # Cost
/// Four bytes a texel. Decoding takes three divisions; a stage that leaves words as they are takes none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rgb565Alpha;

impl Rgb565Alpha {
    /// The texels of colours: red, green, blue and alpha.
    #[must_use]
    pub const fn of<const N: usize>(colors: &[[u8; 4]; N]) -> [u32; N] {
        let mut texels = [0; N];
        let mut k = 0;
        while k < N {
            let [r, g, b, a] = colors[k];
            texels[k] = Rgba565::new(Rgba8::new(r, g, b, a)).to_bits();
            k += 1;
        }
        texels
    }
}

impl TexelFormat for Rgb565Alpha {
    type Texel = u32;

    #[inline]
    fn decode(self, texel: u32) -> Rgba8 {
        Rgba565::from_bits(texel).to_rgba8()
    }

    #[inline]
    fn encode(self, color: Rgba8) -> u32 {
        Rgba565::new(color).to_bits()
    }

    #[inline(always)]
    fn rgba565(self, texel: u32) -> Rgba565 {
        Rgba565::from_bits(texel)
    }
}
