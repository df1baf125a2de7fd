//! Targets in embedded-graphics: as images on its mock display, which refuses pixels that are drawn twice or outside,
//! and as displays themselves, against its own framebuffer.

use alberti::glam::Vec3;
use alberti::raster::color::{
    Bayer, Blended, Constant, Dithered, EmbeddedColor, Grey1, Grey2, Grey4, Grey8, ReadColor, Rgb666, Rgb888,
    Xrgb8888, pack,
};
use alberti::shaders::Solid;
use alberti::*;
use embedded_graphics::framebuffer::{Framebuffer, buffer_size};
use embedded_graphics::image::{GetPixel, Image, ImageDrawable, ImageRaw};
use embedded_graphics::mock_display::{ColorMapping, MockDisplay};
use embedded_graphics::mono_font::{MonoTextStyle, ascii::FONT_6X10};
use embedded_graphics::pixelcolor::raw::{BigEndian, LittleEndian, RawU16};
use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Rgb565};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{Circle, PrimitiveStyle, PrimitiveStyleBuilder, Rectangle, Triangle};
use embedded_graphics::text::Text;

const SIZE: [u32; 2] = [6, 5];
const PIXELS: usize = 30;
/// Red is a surface in the view, drawn by the pipeline; yellow a corner that is cleared.
const PATTERN: [&str; 5] = ["BBBBBB", "BRRRRB", "BRRRRB", "BBBBYY", "BBBBYY"];

/// The pattern in a target of its size, or a part of its rows.
fn draw_pattern<C: ColorFormat>(target: &mut Target<'_, C, D16>) {
    target.clear(Rgba8::from_rgb24(0xff));
    target.scissor(4..6, 3..5).clear(Rgba8::from_rgb24(0xff_ff_00));
    // A unit is a pixel, so that no sample is near the rectangle's edges.
    let camera = Camera::look_at(Vec3::Z, Vec3::ZERO, Vec3::Y).expect("a direction");
    let view = camera.parallel(5.0, 0.0..2.0).expect("a box");
    let corners = [[-2.0, 1.5], [-2.0, -0.5], [2.0, -0.5], [2.0, 1.5]].map(|[x, y]| Vec3::new(x, y, 0.0));
    let mesh = Mesh::new(&corners, &[[0u8, 1, 2], [0, 2, 3]], |corner| (*corner, ()));
    draw(target, &view, &mesh, Solid(Rgba8::from_rgb24(0xff_00_00)));
}

/// The pattern as an image on the mock display.
fn shown<C: EmbeddedColor<Color: ColorMapping>>(format: C, pixel: C::Pixel) -> MockDisplay<C::Color> {
    let (mut color, mut depth) = ([pixel; PIXELS], [0; PIXELS]);
    let mut target = Target::new(format, D16, SIZE[0], SIZE[1], &mut color, &mut depth).expect("fits");
    draw_pattern(&mut target);
    let mut display = MockDisplay::new();
    Image::new(&target.image(), Point::zero()).draw(&mut display).expect("never fails");
    display
}

#[test]
fn colours_are_those_of_the_format() {
    shown(Rgb565Be, 0).assert_pattern(&PATTERN);
    shown(Rgb565Le, 0).assert_pattern(&PATTERN);
    shown(Rgb888, [0; 3]).assert_pattern(&PATTERN);
    shown(Rgba8888, 0).assert_pattern(&PATTERN);
    shown(Xrgb8888, 0).assert_pattern(&PATTERN);
    // Luminance by BT.601: 29, 77 and 227 of 255 (blue, red, yellow), in 16, 4 and 2 levels.
    let letters =
        |of: [&str; 3]| PATTERN.map(|row| row.replace('B', of[0]).replace('R', of[1]).replace('Y', of[2]));
    let check = |rows: [String; 5], assert: &dyn Fn(&[&str])| assert(&rows.each_ref().map(String::as_str));
    check(letters(["2", "5", "D"]), &|rows| shown(Grey4, 0).assert_pattern(rows));
    check(letters(["0", "1", "3"]), &|rows| shown(Grey2, 0).assert_pattern(rows));
    check(letters([".", ".", "#"]), &|rows| shown(Grey1, 0).assert_pattern(rows));
}

/// Checks that colours of embedded-graphics are shown as by the format itself, and come back as the same pixel.
fn round_trips<C: EmbeddedColor<Pixel: PartialEq> + ReadColor>(
    format: C,
    channels: impl Fn(C::Color) -> [u8; 3],
) {
    for step in 0..=255 {
        let color = Rgba8::new(step, 255 - step, step.wrapping_mul(7), 255);
        let pixel = format.pixel(color);
        let embedded = format.to_embedded(pixel);
        assert!(format.of_embedded(embedded) == pixel, "{format:?} {color:?}");
        let [r, g, b, _] = format.color(pixel).to_bytes();
        assert_eq!(channels(embedded), [r, g, b], "{format:?} {color:?}");
    }
}

#[test]
fn colours_go_there_and_back() {
    use embedded_graphics::pixelcolor::{Gray8, Rgb666 as Color666, Rgb888 as Color888};
    // The nearest byte of a level, in integers.
    let byte =
        |level: u8, greatest: u32| ((u32::from(level) * 510 + greatest) / (2 * greatest)).to_le_bytes()[0];
    let of565 = |c: Rgb565| [byte(c.r(), 31), byte(c.g(), 63), byte(c.b(), 31)];
    round_trips(Rgb565Be, of565);
    round_trips(Rgb565Le, of565);
    round_trips(Rgb666, |c: Color666| [c.r(), c.g(), c.b()].map(|level| byte(level, 63)));
    let of888 = |c: Color888| [c.r(), c.g(), c.b()];
    round_trips(Rgb888, of888);
    round_trips(Rgba8888, of888);
    round_trips(Xrgb8888, of888);
    round_trips(Grey8, |c: Gray8| [c.luma(); 3]);
}

#[test]
fn bands_are_shown_at_their_rows() {
    let (mut color, mut depth) = ([0; 12], [0; 12]);
    let mut bands = Bands::new(Rgb565Be, D16, SIZE[0], SIZE[1], &mut color, &mut depth).expect("fits");
    let mut display = MockDisplay::<Rgb565>::new();
    while let Some(mut band) = bands.next_band() {
        draw_pattern(&mut band);
        band.show(&mut display.translated(Point::new(1, 2))).expect("never fails");
    }
    let mut rows = vec![" ".repeat(7); 2];
    rows.extend(PATTERN.map(|row| format!(" {row}")));
    display.assert_pattern(&rows.iter().map(String::as_str).collect::<Vec<_>>());
}

#[test]
fn bytes_are_a_raw_image() {
    let (mut color, mut depth) = ([0; PIXELS], [0; PIXELS]);
    let mut target = Target::new(Rgb565Le, D16, SIZE[0], SIZE[1], &mut color, &mut depth).expect("fits");
    draw_pattern(&mut target);
    let raw: ImageRaw<'_, Rgb565, LittleEndian> = target.image_raw().expect("whole rows");
    let mut display = MockDisplay::new();
    raw.draw(&mut display).expect("never fails");
    display.assert_pattern(&PATTERN);
    let image = target.image();
    for place in Rectangle::new(Point::new(-1, -1), Size::new(8, 7)).points() {
        assert_eq!(image.pixel(place), raw.pixel(place), "{place}");
    }
}

/// Black and white in a pattern, and red over blue by half: as any image, and as displays that store what is drawn to
/// them as it is.
#[test]
fn formats_around_a_format_are_shown_as_that() {
    let (mut color, mut depth) = ([0; PIXELS], [0; PIXELS]);
    let dithered = Dithered { format: Grey1, by: Bayer };
    let mut target = Target::new(dithered, D16, SIZE[0], SIZE[1], &mut color, &mut depth).expect("fits");
    draw_pattern(&mut target);
    let column = Rectangle::new(Point::new(2, 0), Size::new(1, 5));
    target.fill_solid(&column, BinaryColor::On).expect("never fails");
    let (mut display, image) = (MockDisplay::new(), target.image());
    Image::new(&image, Point::zero()).draw(&mut display).expect("never fails");
    for place in target.bounding_box().points() {
        let shown = display.get_pixel(place);
        assert_eq!(shown, image.pixel(place), "{place}");
        assert!(shown == Some(BinaryColor::On) || !column.contains(place), "{place}");
    }

    let (mut color, mut depth) = ([0; PIXELS], [0; PIXELS]);
    let half = Blended { format: Rgb565Be, by: Constant(128) };
    let mut target = Target::new(half, D16, SIZE[0], SIZE[1], &mut color, &mut depth).expect("fits");
    draw_pattern(&mut target);
    // A colour that is drawn to it is not mixed.
    Rectangle::new(Point::new(0, 4), Size::new(2, 1))
        .into_styled(PrimitiveStyle::with_fill(Rgb565::GREEN))
        .draw(&mut target)
        .expect("never fails");
    let mut display = MockDisplay::new();
    target.show(&mut display).expect("never fails");
    // Red over blue is neither.
    display.set_allow_overdraw(true);
    for place in Rectangle::new(Point::new(1, 1), Size::new(4, 2)).points() {
        let mixed = display.get_pixel(place).expect("shown");
        assert!(mixed.r().abs_diff(16) <= 1 && mixed.g() == 0 && mixed.b().abs_diff(16) <= 1, "{mixed:?}");
        display.set_pixel(place, Some(Rgb565::RED));
    }
    display.assert_pattern(&["BBBBBB", "BRRRRB", "BRRRRB", "BBBBYY", "GGBBYY"]);
    let mut raw = MockDisplay::<Rgb565>::new();
    target.image_raw().expect("whole rows").draw(&mut raw).expect("never fails");
    let mut shown = MockDisplay::new();
    target.show(&mut shown).expect("never fails");
    raw.assert_eq(&shown);
}

#[test]
fn packed_greys_are_a_raw_image() {
    let (mut color, mut depth) = ([0; PIXELS], [0; PIXELS]);
    // An odd width, so that rows end in half a byte.
    let mut target = Target::new(Grey4, D16, 5, 6, &mut color, &mut depth).expect("fits");
    target.clear(Rgba8::WHITE);
    target.scissor(1..3, 2..4).clear(Rgba8::BLACK);
    let mut display = MockDisplay::new();
    ImageRaw::<Gray4>::new(pack::grey4(&mut color, 5), 5).draw(&mut display).expect("never fails");
    display.assert_pattern(&["FFFFF", "FFFFF", "F00FF", "F00FF", "FFFFF", "FFFFF"]);
}

#[test]
fn windows_are_shown_without_their_neighbours() {
    // 6 x 5 in rows of 8, the last of which ends with the window.
    let (mut color, mut depth) = ([u16::from_be(0x07e0); 8 * 4 + 6], [0; PIXELS]);
    let mut window =
        Target::window(Rgb565Be, D16, SIZE, 0..SIZE[1], 8, &mut color, &mut depth).expect("fits");
    draw_pattern(&mut window);
    assert!(window.image_raw().is_none());
    let mut display = MockDisplay::new();
    window.show(&mut display).expect("never fails");
    display.assert_pattern(&PATTERN);

    let part = |area: Rectangle| {
        let mut display = MockDisplay::new();
        window.image().draw_sub_image(&mut display, &area).expect("never fails");
        display
    };
    part(Rectangle::new(Point::new(3, 2), Size::new(3, 2))).assert_pattern(&["RRB", "BYY"]);
    for outside in [[-1, 0], [4, 0], [0, 4], [0, -1]] {
        let outside = Rectangle::new(outside.into(), Size::new(3, 2));
        part(outside).assert_eq(&MockDisplay::new());
    }
}

const FRAME: [usize; 2] = [48, 40];

/// Texts and shapes, some of them partly or wholly outside of the frame.
fn interface<D: DrawTarget<Color = Rgb565, Error: std::fmt::Debug>>(display: &mut D) {
    let all = |display: &mut D| -> Result<(), D::Error> {
        display.clear(Rgb565::new(1, 2, 3))?;
        Text::new("alberti\n 3D", Point::new(-4, 9), MonoTextStyle::new(&FONT_6X10, Rgb565::YELLOW))
            .draw(display)?;
        let style =
            PrimitiveStyleBuilder::new().fill_color(Rgb565::CYAN).stroke_color(Rgb565::RED).stroke_width(2);
        Circle::new(Point::new(30, 25), 23).into_styled(style.build()).draw(display)?;
        Triangle::new(Point::new(-9, 12), Point::new(22, 50), Point::new(25, 3))
            .into_styled(PrimitiveStyle::with_stroke(Rgb565::MAGENTA, 1))
            .draw(display)?;
        let mut step = 0;
        let mut colors = || {
            step += 1;
            std::iter::successors(Some(step), |k: &u16| Some(k.wrapping_mul(25_173).wrapping_add(13_849)))
                .map(|k| Rgb565::from(RawU16::new(k)))
        };
        let areas =
            [(2, 3, 9, 4), (-3, -2, 8, 5), (40, 33, 12, 9), (-5, 20, 60, 3), (20, -9, 4, 60), (60, 5, 3, 3)];
        for (x, y, width, height) in areas {
            let size = Size::new(width, height);
            display.fill_contiguous(&Rectangle::new(Point::new(x, y), size), colors())?;
            display.fill_solid(&Rectangle::new(Point::new(x + 5, y + 9), size), Rgb565::GREEN)?;
        }
        // Fewer colours than the area takes, which end within a row.
        display.fill_contiguous(&Rectangle::new(Point::new(-2, 14), Size::new(11, 4)), colors().take(27))
    };
    all(display).expect("never fails");
}

#[test]
fn interfaces_are_drawn_as_by_a_framebuffer() {
    const BYTES: usize = buffer_size::<Rgb565>(FRAME[0], FRAME[1]);
    let mut reference = Framebuffer::<Rgb565, RawU16, BigEndian, { FRAME[0] }, { FRAME[1] }, BYTES>::new();
    interface(&mut reference);

    let size = FRAME.map(|side| u32::try_from(side).expect("small"));
    for rows in [40, 16, 7, 1] {
        let (mut color, mut depth) = (vec![0; FRAME[0] * rows], vec![9_u16; FRAME[0] * rows]);
        let mut bands = Bands::new(Rgb565Be, D16, size[0], size[1], &mut color, &mut depth).expect("fits");
        let mut bytes = Vec::new();
        while let Some(mut band) = bands.next_band() {
            interface(&mut band);
            bytes.extend_from_slice(band.bytes());
        }
        assert!(bytes == reference.data(), "bands of {rows} rows");
        assert_eq!(depth, vec![9; FRAME[0] * rows], "depths stay");
    }
}

#[test]
fn interfaces_stay_within_limits() {
    let (mut color, mut depth) = ([0; PIXELS], [(); PIXELS]);
    let mut target = Target::new(Rgb565Be, NoDepth, SIZE[0], SIZE[1], &mut color, &mut depth).expect("fits");
    let mut part = target.scissor(1..4, 2..3);
    assert_eq!(part.bounding_box(), Rectangle::new(Point::zero(), Size::new(6, 5)));
    DrawTarget::clear(&mut part, Rgb565::GREEN).expect("never fails");
    let everywhere = part.bounding_box().points().map(|place| Pixel(place, Rgb565::RED));
    part.draw_iter(everywhere.filter(|Pixel(place, _)| place.x != 2)).expect("never fails");
    let mut display = MockDisplay::new();
    target.show(&mut display).expect("never fails");
    display.assert_pattern(&["KKKKKK", "KKKKKK", "KRGRKK", "KKKKKK", "KKKKKK"]);
}
