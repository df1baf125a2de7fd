//! The ways of a frame to a display by its driver, of 240x320 pixels of RGB565: its bytes, and its pixels by
//! embedded-graphics and mipidsi. And embedded-graphics drawing upon it: rows, and pixels that come alone.
//!
//! The bus copies what it is sent. Before a way is timed, that is held against the frame's bytes, or the frame against
//! what is drawn.

use alberti::glam::Vec3;
use alberti::shaders::VertexColor;
use alberti::{Camera, Mesh, NoDepth, Rgb565Be, Rgba8, Target, draw};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::{Operation, SpiDevice};
use mipidsi::interface::SpiInterface;
use mipidsi::models::ST7789;
use std::cell::RefCell;
use std::convert::Infallible;
use std::hint::black_box;
use std::time::Duration;

const WIDTH: u32 = 240;
const HEIGHT: u32 = 320;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;

/// The bytes that were sent.
struct Bus<'a>(&'a RefCell<Vec<u8>>);

impl embedded_hal::spi::ErrorType for Bus<'_> {
    type Error = Infallible;
}

impl SpiDevice for Bus<'_> {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Infallible> {
        let mut sent = self.0.borrow_mut();
        for operation in operations {
            if let Operation::Write(bytes) = operation {
                sent.extend_from_slice(bytes);
            }
        }
        Ok(())
    }
}

/// Pins and delays that do nothing.
struct Nothing;

impl embedded_hal::digital::ErrorType for Nothing {
    type Error = Infallible;
}

impl OutputPin for Nothing {
    fn set_low(&mut self) -> Result<(), Infallible> {
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

impl DelayNs for Nothing {
    fn delay_ns(&mut self, _: u32) {}
}

/// A triangle of all colours before black.
fn picture(target: &mut Target<'_, Rgb565Be, NoDepth>) {
    let vertices = [
        (Vec3::new(-1.0, -1.0, 0.0), Vec3::X),
        (Vec3::new(1.0, -1.0, 0.0), Vec3::Y),
        (Vec3::new(0.0, 1.0, 0.0), Vec3::Z),
    ];
    let camera = Camera::look_at(Vec3::Z * 2.0, Vec3::ZERO, Vec3::Y).expect("a direction");
    let view = camera.perspective(1.0, 0.1..10.0).expect("a lens");
    target.clear(Rgba8::BLACK);
    draw(target, &view, &Mesh::new(&vertices, &[[0_u16, 1, 2]], |v| *v), VertexColor);
}

fn displays(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("displays");
    group.throughput(Throughput::Elements(PIXELS as u64));
    let sent = RefCell::new(Vec::with_capacity(4 * PIXELS));
    let mut buffer = [0; 4096];
    let interface = SpiInterface::new(Bus(&sent), Nothing, &mut buffer);
    let mut display = mipidsi::Builder::new(ST7789, interface).init(&mut Nothing).expect("a display");

    let (mut color, mut depth) = (vec![0; PIXELS], vec![(); PIXELS]);
    let mut target = Target::new(Rgb565Be, NoDepth, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
    picture(&mut target);
    let frame = target.bytes().to_vec();
    let colors = frame.as_chunks::<2>().0;
    assert!(colors.iter().filter(|color| **color != [0; 2]).count() > PIXELS / 8, "a triangle");

    let mut bus = Bus(&sent);
    macro_rules! ways {
        ($($name:literal: $send:expr;)+) => {$({
            let mut send = || {
                sent.borrow_mut().clear();
                $send.expect("nothing fails");
            };
            send();
            assert!(sent.borrow().ends_with(&frame), "{}: other pixels are sent", $name);
            assert!(sent.borrow().len() < frame.len() + 32, "{}: more is sent", $name);
            group.bench_function($name, |bencher| bencher.iter(&mut send));
        })+};
    }
    ways! {
        "bytes": bus.write(black_box(target.bytes()));
        "show": target.show(&mut display);
        "image": Image::new(&target.image(), Point::zero()).draw(&mut display);
        "image_raw": Image::new(&target.image_raw().expect("whole rows"), Point::zero()).draw(&mut display);
    }

    let (area, green) = (target.bounding_box(), black_box(Rgb565::GREEN));
    macro_rules! drawings {
        ($($name:literal: $draw:expr;)+) => {$({
            picture(&mut target);
            let mut drawing = || $draw.expect("nothing fails");
            drawing();
            assert!(target.pixels().iter().all(|pixel| *pixel == 0x07e0_u16.to_be()), "{}: not green", $name);
            group.bench_function($name, |bencher| bencher.iter(|| $draw.expect("nothing fails")));
        })+};
    }
    drawings! {
        "rows drawn upon it": target.fill_solid(&area, green);
        "pixels drawn upon it": target.draw_iter(area.points().map(|place| Pixel(place, green)));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(2));
    targets = displays
}
criterion_main!(benches);
