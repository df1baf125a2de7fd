//! Bytes on the wire, as a display would take them: each with the level of the data pin beside it.

extern crate std;

use super::*;
use core::cell::RefCell;
use core::future::Future;
use core::pin::pin;
use core::task::{Context, Poll, Waker};
use embassy_futures::block_on;
use embassy_time::Duration;
use embedded_hal::digital::ErrorType as PinError;
use embedded_hal::spi::ErrorType;
use std::rc::Rc;
use std::vec::Vec;

/// Everything that the display sees, in order.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Event {
    Pin(&'static str, bool),
    Bytes(Vec<u8>),
    /// A transfer by DMA, whose first poll this is.
    Transfer(Vec<u8>),
    Delay(u32),
    Frame,
}
use Event::*;

#[derive(Clone, Default)]
struct Log(Rc<RefCell<Vec<Event>>>);

impl Log {
    fn push(&self, event: Event) {
        self.0.borrow_mut().push(event);
    }

    fn take(&self) -> Vec<Event> {
        self.0.take()
    }
}

struct Pin(&'static str, Log);

impl PinError for Pin {
    type Error = Infallible;
}

impl OutputPin for Pin {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.1.push(Event::Pin(self.0, false));
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.1.push(Event::Pin(self.0, true));
        Ok(())
    }
}

/// A bus whose transfers end at their second poll.
struct Bus(Log);

impl ErrorType for Bus {
    type Error = Infallible;
}

impl SpiBus for Bus {
    fn read(&mut self, _: &mut [u8]) -> Result<(), Infallible> {
        panic!("a display is not read")
    }

    fn write(&mut self, words: &[u8]) -> Result<(), Infallible> {
        self.0.push(Bytes(words.to_vec()));
        Ok(())
    }

    fn transfer(&mut self, _: &mut [u8], _: &[u8]) -> Result<(), Infallible> {
        panic!("a display is not read")
    }

    fn transfer_in_place(&mut self, _: &mut [u8]) -> Result<(), Infallible> {
        panic!("a display is not read")
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

impl Transfers for Bus {
    async fn read(&mut self, _: &mut [u8]) -> Result<(), Infallible> {
        panic!("a display is not read")
    }

    async fn write(&mut self, words: &[u8]) -> Result<(), Infallible> {
        self.0.push(Transfer(words.to_vec()));
        embassy_futures::yield_now().await;
        Ok(())
    }

    async fn transfer(&mut self, _: &mut [u8], _: &[u8]) -> Result<(), Infallible> {
        panic!("a display is not read")
    }

    async fn transfer_in_place(&mut self, _: &mut [u8]) -> Result<(), Infallible> {
        panic!("a display is not read")
    }

    async fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

struct Clock(Log);

impl DelayNs for Clock {
    async fn delay_ns(&mut self, nanoseconds: u32) {
        self.0.push(Delay(nanoseconds));
    }

    async fn delay_ms(&mut self, milliseconds: u32) {
        self.0.push(Delay(milliseconds * 1_000_000));
    }
}

/// A pin whose rising edge is when the closure's future is ready.
pub(crate) struct Rising<F>(pub(crate) F);

impl<F> PinError for Rising<F> {
    type Error = Infallible;
}

impl<F: AsyncFnMut()> Wait for Rising<F> {
    async fn wait_for_rising_edge(&mut self) -> Result<(), Infallible> {
        (self.0)().await;
        Ok(())
    }

    async fn wait_for_high(&mut self) -> Result<(), Infallible> {
        panic!("an edge is waited for")
    }

    async fn wait_for_low(&mut self) -> Result<(), Infallible> {
        panic!("an edge is waited for")
    }

    async fn wait_for_falling_edge(&mut self) -> Result<(), Infallible> {
        panic!("an edge is waited for")
    }

    async fn wait_for_any_edge(&mut self) -> Result<(), Infallible> {
        panic!("an edge is waited for")
    }
}

fn panel(chip: Chip, log: &Log) -> Panel<Bus, Pin, Rising<impl AsyncFnMut()>> {
    let pins = ["select", "data", "reset"].map(|name| Pin(name, log.clone()));
    let [select, data, reset] = pins;
    let frames = log.clone();
    let pace = Pace::new(Duration::MIN, Rising(async move || frames.push(Frame)));
    let mut delay = Clock(log.clone());
    let Ok(panel) =
        block_on(Panel::new(chip, Bus(log.clone()), Pins { select, data, reset }, &mut delay, pace));
    panel
}

/// A command as it is on the wire.
fn command(code: u8, data: &[u8]) -> Vec<Event> {
    let mut events =
        Vec::from([Event::Pin("data", false), Bytes(Vec::from([code])), Event::Pin("data", true)]);
    if !data.is_empty() {
        events.push(Bytes(data.to_vec()));
    }
    events
}

/// The codes and numbers are those of the data sheets: of the ST7789V, version 1.6, chapter 9; of the ILI9341, version
/// 1.11, chapter 8.
#[test]
fn the_display_wakes_as_its_data_sheet_says() {
    let st7789 = |format| (Chip::St7789(format), 0b0110_0000, 0x21);
    for ((chip, orientation, inversion), format, zeros) in [
        (st7789(PixelFormat::Rgb565), 0b0101_0101, 1200),
        (st7789(PixelFormat::Rgb444), 0b0101_0011, 900),
        ((Chip::Ili9341, 0b0010_1000, 0x20), 0b0101_0101, 1200),
    ] {
        let log = Log::default();
        panel(chip, &log);
        let mut expected = Vec::from([
            Event::Pin("select", false),
            Event::Pin("reset", false),
            Delay(10_000_000),
            Event::Pin("reset", true),
            Delay(120_000_000),
        ]);
        expected.extend(command(0x11, &[]));
        expected.push(Delay(120_000_000));
        expected.extend(command(0x3a, &[format]));
        expected.extend(command(0x36, &[orientation]));
        expected.extend(command(inversion, &[]));
        expected.extend(command(0x35, &[0]));
        expected.extend(command(0x2a, &[0, 0, 1, 0x3f]));
        expected.extend(command(0x2b, &[0, 0, 0, 239]));
        expected.extend(command(0x2c, &[]));
        expected.extend((0..zeros).map(|_| Bytes(Vec::from([0; 128]))));
        expected.extend(command(0x29, &[]));
        assert_eq!(log.take(), expected, "{chip:?}");
    }
}

const RGB565: Chip = Chip::St7789(PixelFormat::Rgb565);

#[test]
fn rectangles_go_to_their_window() {
    let log = Log::default();
    let mut panel = panel(RGB565, &log);
    log.take();
    let pixels = [0x12; 3 * 640];
    let Ok(()) = block_on(async {
        panel.begin().await?;
        panel.send(0..320, 230..233, &pixels).await?;
        panel.send(255..258, 7..9, &pixels[..12]).await?;
        panel.send(255..258, 9..10, &pixels[..6]).await?;
        panel.send(255..259, 9..10, &pixels[..8]).await
    });
    let mut expected = Vec::from([Frame]);
    // Columns only where they are others than before: at first all.
    let mut window = |columns: &[u8], rows: [u8; 4], bytes: usize| {
        if !columns.is_empty() {
            expected.extend(command(0x2a, columns));
        }
        expected.extend(command(0x2b, &rows));
        expected.extend(command(0x2c, &[]));
        expected.push(Transfer(Vec::from(&pixels[..bytes])));
    };
    window(&[], [0, 230, 0, 232], 1920);
    window(&[0, 255, 1, 1], [0, 7, 0, 8], 12);
    window(&[], [0, 9, 0, 9], 6);
    window(&[0, 255, 1, 2], [0, 9, 0, 9], 8);
    assert_eq!(log.take(), expected);
}

/// A band of 12 bits a pixel, of which columns 3 to 7 changed: 2 to 7 are sent, in whole bytes.
#[test]
fn pixels_of_twelve_bits_share_bytes() {
    use alberti::raster::color::{Rgb444, pack};
    use alberti::{NoDepth, Rgba8, Target, Touched};
    const WIDE: usize = WIDTH as usize;
    let (mut color, mut depth) = ([[0; 2]; 4 * WIDE], [(); 4 * WIDE]);
    let mut band = Target::band(Rgb444, NoDepth, [320, 240], 16, &mut color, &mut depth).expect("four rows");
    band.clear(Rgba8::from_rgb24(0x11_22_33));
    band.scissor(3..8, 17..20).clear(Rgba8::from_rgb24(0xaa_bb_cc));
    band.scissor(7..8, 19..20).clear(Rgba8::from_rgb24(0xdd_ee_ff));
    let changed = Touched::new(3..8, 17..20).aligned(2);
    assert_eq!((changed.columns(), changed.rows()), (2..8, 17..20));
    let bytes = pack::rgb444(pack::rectangle(&mut color, WIDE, 2..8, 1..4));

    let log = Log::default();
    let mut panel = panel(Chip::St7789(PixelFormat::Rgb444), &log);
    log.take();
    let Ok(()) = block_on(panel.send(2..8, 17..20, bytes));
    let row = [0x12, 0x3a, 0xbc, 0xab, 0xca, 0xbc, 0xab, 0xca, 0xbc];
    let last = [0x12, 0x3a, 0xbc, 0xab, 0xca, 0xbc, 0xab, 0xcd, 0xef];
    let mut expected = command(0x2a, &[0, 2, 0, 7]);
    expected.extend(command(0x2b, &[0, 17, 0, 19]));
    expected.extend(command(0x2c, &[]));
    expected.push(Transfer([row, row, last].concat()));
    assert_eq!(log.take(), expected);
}

/// Whoever draws while rows are sent polls once before, and must not be the one for whom the transfer waits.
#[test]
fn the_first_poll_begins_the_transfer() {
    let log = Log::default();
    let mut panel = panel(Chip::Ili9341, &log);
    log.take();
    let pixels = [7; 640];
    let mut sending = pin!(panel.send(0..320, 0..1, &pixels));
    let mut context = Context::from_waker(Waker::noop());
    assert_eq!(sending.as_mut().poll(&mut context), Poll::Pending);
    assert_eq!(log.take().last(), Some(&Transfer(pixels.to_vec())));
    assert_eq!(sending.as_mut().poll(&mut context), Poll::Ready(Ok(())));
}
