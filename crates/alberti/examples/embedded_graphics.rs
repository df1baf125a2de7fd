//! A view of hills with instruments upon it: texts, a battery and a dial of embedded-graphics, drawn in the memory of
//! each band of sixteen rows after the hills. A display would get the bytes of the bands; here it is the simulator of
//! embedded-graphics, which gets them as colours.
//!
//!     cargo run --release -p alberti --features embedded-graphics --example embedded_graphics -- embedded_graphics.png

mod common;

use alberti::glam::Vec3;
use alberti::shaders::VertexColor;
use alberti::texture::surface::Grid;
use alberti::*;
use embedded_graphics::mono_font::MonoTextStyle;
use embedded_graphics::mono_font::ascii::{FONT_6X10, FONT_10X20};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{
    Arc, Circle, CornerRadii, Line, PrimitiveStyle, PrimitiveStyleBuilder, Rectangle, RoundedRectangle,
};
use embedded_graphics::text::{Alignment, Text};
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};
use std::process::ExitCode;

const SIZE: [u32; 2] = [320, 240];
/// Pixels of the sixteen rows that there is memory for.
const PIXELS: usize = SIZE[0] as usize * 16;
const GRID: Grid = Grid::new(56, 56);
const SKY: Rgba8 = Rgba8::from_rgb24(0x98_c0_e8);

fn main() -> ExitCode {
    common::write("embedded_graphics.png", picture)
}

fn picture() -> common::File {
    let mut display = SimulatorDisplay::<Rgb565>::new(Size::new(SIZE[0], SIZE[1]));
    frame(&mut display)?;
    let image = display.to_rgb_output_image(&OutputSettings::default());
    let mut file = std::io::Cursor::new(Vec::new());
    image.as_image_buffer().write_to(&mut file, image::ImageFormat::Png)?;
    Ok(file.into_inner())
}

/// Draws a frame on any display of embedded-graphics.
///
/// # Errors
/// Those of the display, and of a view or bands that cannot be.
fn frame<D: DrawTarget<Color = Rgb565, Error: std::error::Error + 'static>>(
    display: &mut D,
) -> Result<(), Box<dyn std::error::Error>> {
    let (mut color, mut depth) = ([0; PIXELS], [0; PIXELS]);
    let view = Camera::look_at(Vec3::new(0.0, 1.0, 3.6), Vec3::new(0.0, 0.25, 0.0), Vec3::Y)?
        .perspective(0.8, 0.2..12.0)?;
    let count = |n: usize| u32::try_from(n).unwrap_or(0);
    let vertices: Vec<Vec3> = (0..count(GRID.vertices())).map(|k| hill(GRID.uv(k).into())).collect();
    let triangles: Vec<[u32; 3]> = (0..count(GRID.triangles())).map(|k| GRID.triangle(k)).collect();
    let mesh = Mesh::new(&vertices, &triangles, |place| (*place, color_of(*place)));

    let mut bands = Bands::new(Rgb565Be, D16, SIZE[0], SIZE[1], &mut color, &mut depth)?;
    while let Some(mut band) = bands.next_band() {
        band.clear(SKY);
        draw(&mut band, &view, &mesh, VertexColor);
        let Ok(()) = instruments(&mut band);
        // With a driver that takes bytes, this is `send(band.bytes())`.
        band.show(display)?;
    }
    Ok(())
}

/// The place of (u, v) on the ground: three hills in a plain, of basic operations, so that it is the same everywhere.
fn hill([u, v]: [f32; 2]) -> Vec3 {
    let [x, z] = [(u - 0.5) * 8.0, (0.5 - v) * 7.0];
    let bump = |[at_x, at_z]: [f32; 2], height: f32, width: f32| {
        let near = 1.0 + ((x - at_x) * (x - at_x) + (z - at_z) * (z - at_z)) / (width * width);
        height / (near * near)
    };
    let y = bump([-1.1, -0.6], 1.05, 0.9) + bump([1.3, -1.6], 1.4, 1.1) + bump([0.5, 0.9], 0.35, 0.6);
    Vec3::new(x, y, z)
}

/// Grass, rock and snow, lit from the left: the slope is that of the hills a little to the left.
fn color_of(place: Vec3) -> Vec3 {
    let [u, v] = [place.x / 8.0 + 0.5, 0.5 - place.z / 7.0];
    let slope = (place.y - hill([u - 0.01, v]).y) / 0.08;
    let light = (0.72 + 0.6 * slope).clamp(0.25, 1.0);
    let (grass, rock, snow) = (Vec3::new(0.32, 0.56, 0.24), Vec3::new(0.52, 0.45, 0.38), Vec3::splat(0.98));
    let mix =
        |a: Vec3, b: Vec3, from: f32, to: f32| a.lerp(b, ((place.y - from) / (to - from)).clamp(0.0, 1.0));
    mix(mix(grass, rock, 0.25, 0.55), snow, 0.75, 0.95) * light
}

/// Whatever the view shows: what embedded-graphics draws upon it. For each band it is the same code.
fn instruments<D: DrawTarget<Color = Rgb565>>(display: &mut D) -> Result<(), D::Error> {
    let small = MonoTextStyle::new(&FONT_6X10, Rgb565::WHITE);
    let large = MonoTextStyle::new(&FONT_10X20, Rgb565::WHITE);
    let dark = PrimitiveStyle::with_fill(Rgb565::new(3, 8, 6));
    let plate = |place: Point, size: Size| {
        RoundedRectangle::new(Rectangle::new(place, size), CornerRadii::new(Size::new_equal(6)))
    };

    plate(Point::new(8, 8), Size::new(104, 36)).into_styled(dark).draw(display)?;
    Text::new("ALTITUDE", Point::new(16, 19), small).draw(display)?;
    Text::new("1240 m", Point::new(16, 37), large).draw(display)?;

    // A battery with three quarters of its charge.
    let line = PrimitiveStyleBuilder::new().stroke_color(Rgb565::WHITE).stroke_width(2);
    plate(Point::new(258, 8), Size::new(54, 26)).into_styled(dark).draw(display)?;
    Rectangle::new(Point::new(265, 13), Size::new(36, 16)).into_styled(line.build()).draw(display)?;
    Rectangle::new(Point::new(302, 18), Size::new(4, 6)).into_styled(fill(Rgb565::WHITE)).draw(display)?;
    for bar in 0..3 {
        let place = Rectangle::new(Point::new(268 + 8 * bar, 16), Size::new(6, 10));
        place.into_styled(fill(Rgb565::CSS_LIME_GREEN)).draw(display)?;
    }

    // A dial, whose needle points to two thirds of the scale.
    let center = Point::new(264, 184);
    Circle::with_center(center, 100).into_styled(dark).draw(display)?;
    let arc = |color, from: f32, sweep: f32| {
        let style = PrimitiveStyleBuilder::new().stroke_color(color).stroke_width(5).build();
        Arc::with_center(center, 84, from.deg(), sweep.deg()).into_styled(style)
    };
    arc(Rgb565::CSS_LIME_GREEN, 150.0, 160.0).draw(display)?;
    arc(Rgb565::CSS_ORANGE, 310.0, 50.0).draw(display)?;
    arc(Rgb565::RED, 0.0, 30.0).draw(display)?;
    Line::new(center, center + Point::new(17, -29)).into_styled(line.build()).draw(display)?;
    Circle::with_center(center, 9).into_styled(fill(Rgb565::WHITE)).draw(display)?;
    Text::with_alignment("62", center + Point::new(0, 28), large, Alignment::Center).draw(display)?;
    Text::with_alignment("km/h", center + Point::new(0, 39), small, Alignment::Center).draw(display)?;
    Ok(())
}

fn fill(color: Rgb565) -> PrimitiveStyle<Rgb565> {
    PrimitiveStyle::with_fill(color)
}
