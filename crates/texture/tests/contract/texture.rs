//! Construction and access.

use alberti_math::Rgba8;
use alberti_texture::format::{L8, Rgb8, Rgb565};
use alberti_texture::{Bilinear, Repeat, Sampler, Texture, TextureError};
use glam::Vec2;

static TEXELS: [u16; 4] = [0xf800, 0x07e0, 0x001f, 0xffff];
static TEXTURE: Texture<'static, Rgb565> = match Texture::new(Rgb565, &TEXELS, 2, 2) {
    Ok(texture) => texture,
    Err(_) => panic!("four texels for 2 x 2"),
};
static SAMPLER: Sampler<'static, Rgb565, Bilinear, Repeat> = TEXTURE.sampler(Bilinear, Repeat);

#[test]
fn statics() {
    assert_eq!(SAMPLER.sample(Vec2::new(0.25, 0.75)), Rgba8::new(255, 0, 0, 255));
    assert_eq!(SAMPLER.sample(Vec2::new(0.0, 0.0)), Rgba8::new(128, 128, 128, 255));
    assert_eq!(SAMPLER.texture().texels(), &TEXELS);
    assert_eq!(
        format!("{SAMPLER:?}"),
        "Sampler { texture: Texture { width: 2, height: 2, .. }, filter: Bilinear, wrap: (Repeat, Repeat) }"
    );
}

#[test]
fn errors_say_what_was_found() {
    let new = |width, height| Texture::new(Rgb8, &[[0; 3]; 6], width, height).map(|_| ());
    assert_eq!(new(2, 3), Ok(()));
    assert_eq!(new(6, 1), Ok(()));
    assert_eq!(new(0, 3), Err(TextureError::ZeroSize { width: 0, height: 3 }));
    assert_eq!(new(3, 0), Err(TextureError::ZeroSize { width: 3, height: 0 }));
    assert_eq!(new(16385, 1), Err(TextureError::TooLarge { width: 16385, height: 1 }));
    assert_eq!(new(65536, 65536), Err(TextureError::TooLarge { width: 65536, height: 65536 }));
    assert_eq!(new(1, u32::MAX), Err(TextureError::TooLarge { width: 1, height: u32::MAX }));
    assert_eq!(new(3, 3), Err(TextureError::Length { found: 6, expected: 9 }));
    assert_eq!(new(5, 1), Err(TextureError::Length { found: 6, expected: 5 }));

    let error: &dyn core::error::Error = &TextureError::Length { found: 6, expected: 9 };
    assert_eq!(error.to_string(), "6 texels for a texture that takes 9");
    let limit = Texture::<L8>::MAX_SIZE.to_string();
    assert!(TextureError::TooLarge { width: 16385, height: 1 }.to_string().contains(&limit));
}

#[test]
fn access_is_total() {
    let texture = Texture::new(L8, &[0, 1, 2, 3, 4, 5], 3, 2).unwrap();
    let at = |x, y| texture.texel(x, y).to_bytes()[0];
    assert_eq!([at(0, 0), at(2, 0), at(0, 1), at(2, 1)], [0, 2, 3, 5]);
    assert_eq!([at(u32::MAX, 0), at(0, u32::MAX), at(3, 2), at(u32::MAX, u32::MAX)], [2, 3, 5, 5]);
}
