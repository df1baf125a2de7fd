//! Bands on the wire to a display: the windows' commands and the pixels' bytes that its drivers send, on mock pins.
//!
//! The commands are those of MIPI DCS: 2A and 2B with the first and the last column and row, big-endian, and 2C.

use alberti::*;
use display_interface::{DataFormat, DisplayError, WriteOnlyDataCommand};
use display_interface_spi::SPIInterface;
use embassy_futures::{join::join, yield_now};
use embedded_hal_async::spi::{ErrorKind, ErrorType, Operation, SpiDevice};
use embedded_hal_mock::eh1::delay::NoopDelay;
use embedded_hal_mock::eh1::digital::{Mock as Pin, State, Transaction as Level};
use embedded_hal_mock::eh1::spi::{Mock as Spi, Transaction};
use mipidsi::interface::SpiInterface;
use mipidsi::models::{ILI9341Rgb565, Model, ST7789};
use std::cell::RefCell;

/// A frame in the middle of displays of 240 x 320, in bands of two rows, the last of which has one.
const SIZE: [u16; 2] = [4, 5];
const PLACE: [u16; 2] = [118, 300];
const BACKGROUND: Rgba8 = Rgba8::from_rgb24(0x00_00_ff);
const BAR: Rgba8 = Rgba8::from_rgb24(0xff_80_00);

/// Each band's first row, and its bytes, of blue with an orange bar in column 2: 001f, and fc00, as 0x80 is nearest to
/// 32 of 63.
const BANDS: [(u16, &[u8]); 3] = [
    (0, &[0, 0x1f, 0, 0x1f, 0xfc, 0, 0, 0x1f, 0, 0x1f, 0, 0x1f, 0xfc, 0, 0, 0x1f]),
    (2, &[0, 0x1f, 0, 0x1f, 0xfc, 0, 0, 0x1f, 0, 0x1f, 0, 0x1f, 0xfc, 0, 0, 0x1f]),
    (4, &[0, 0x1f, 0, 0x1f, 0xfc, 0, 0, 0x1f]),
];

/// Draws the bands.
fn bands(mut send: impl FnMut(&Target<'_, Rgb565Be, NoDepth>)) {
    let (mut color, mut depth) = ([0; 8], [(); 8]);
    let [width, height] = SIZE.map(u32::from);
    let mut bands = Bands::new(Rgb565Be, NoDepth, width, height, &mut color, &mut depth).expect("fits");
    bands.draw(BACKGROUND, |band| {
        band.scissor(2..3, 0..5).clear(BAR);
        send(band);
    });
}

/// What goes over the wire, in order, and how the pin that tells data from commands changes.
#[derive(Default)]
struct Wire {
    bytes: Vec<Transaction<u8>>,
    levels: Vec<Level>,
}

impl Wire {
    fn write(&mut self, bytes: &[u8]) {
        self.bytes.extend([
            Transaction::transaction_start(),
            Transaction::write_vec(bytes.to_vec()),
            Transaction::transaction_end(),
        ]);
    }

    fn command(&mut self, command: u8, arguments: &[u8]) {
        self.levels.extend([State::Low, State::High].map(Level::set));
        self.write(&[command]);
        self.write(arguments);
    }

    /// The commands for the window of a band, and its pixels.
    fn band(&mut self, first_row: u16, pixels: &[u8]) {
        let rows = u16::try_from(pixels.len()).expect("small") / (2 * SIZE[0]);
        let ends = |first: u16, count: u16| [first.to_be_bytes(), (first + count - 1).to_be_bytes()].concat();
        self.command(0x2a, &ends(PLACE[0], SIZE[0]));
        self.command(0x2b, &ends(PLACE[1] + first_row, rows));
        self.command(0x2c, &[]);
        self.write(pixels);
    }

    fn mocks(&self) -> (Spi<u8>, Pin) {
        (Spi::new(&self.bytes), Pin::new(&self.levels))
    }
}

/// Reset, orientation as it is, colours as they are, 16 bits a pixel, and out of sleep.
fn start(model: &[(u8, &[u8])]) -> Wire {
    let mut wire = Wire::default();
    wire.command(0x01, &[]);
    model.iter().for_each(|(command, arguments)| wire.command(*command, arguments));
    wire
}

fn st7789() -> Wire {
    start(&[(0x11, &[]), (0x36, &[0]), (0x20, &[]), (0x3a, &[0x55]), (0x13, &[]), (0x29, &[])])
}

fn ili9341() -> Wire {
    start(&[(0x36, &[0]), (0xb4, &[0]), (0x20, &[]), (0x3a, &[0x55]), (0x13, &[]), (0x11, &[]), (0x29, &[])])
}

/// Shows the bands by `fill_contiguous` of mipidsi's display.
fn by_mipidsi<M: Model<ColorFormat = embedded_graphics::pixelcolor::Rgb565>>(model: M, mut wire: Wire) {
    use embedded_graphics::prelude::*;
    BANDS.iter().for_each(|(row, pixels)| wire.band(*row, pixels));
    let ((mut spi, mut pin), mut buffer) = (wire.mocks(), [0; 64]);
    let interface = SpiInterface::new(spi.clone(), pin.clone(), &mut buffer);
    let mut display = mipidsi::Builder::new(model, interface).init(&mut NoopDelay::new()).expect("mocks");
    bands(|band| {
        let place = Point::new(PLACE[0].into(), PLACE[1].into());
        band.show(&mut display.translated(place)).expect("mocks");
    });
    spi.done();
    pin.done();
}

#[test]
fn st7789_by_mipidsi_gets_windows_and_pixels() {
    by_mipidsi(ST7789, st7789());
}

#[test]
fn ili9341_by_mipidsi_gets_windows_and_pixels() {
    by_mipidsi(ILI9341Rgb565, ili9341());
}

/// Sends a band's bytes as they are through display-interface.
fn flush(
    interface: &mut impl WriteOnlyDataCommand,
    columns: [u16; 2],
    rows: [u16; 2],
    bytes: &[u8],
) -> Result<(), DisplayError> {
    for (command, [first, last]) in [(0x2a, columns), (0x2b, rows)] {
        interface.send_commands(DataFormat::U8(&[command]))?;
        interface.send_data(DataFormat::U8(&[first.to_be_bytes(), last.to_be_bytes()].concat()))?;
    }
    interface.send_commands(DataFormat::U8(&[0x2c]))?;
    interface.send_data(DataFormat::U8(bytes))
}

#[test]
fn display_interface_gets_the_bytes_of_bands() {
    let mut wire = Wire::default();
    for (row, pixels) in BANDS {
        wire.band(row, pixels);
    }
    // This driver sends no empty arguments; so the level rises before the pixels.
    let empty = [
        Transaction::transaction_start(),
        Transaction::write_vec(Vec::new()),
        Transaction::transaction_end(),
    ];
    while let Some(at) = wire.bytes.windows(3).position(|three| three == empty) {
        wire.bytes.drain(at..at + 3);
    }
    let (mut spi, mut pin) = wire.mocks();
    let mut interface = SPIInterface::new(spi.clone(), pin.clone());
    bands(|band| {
        let [_, rows] = band.limits().map(|range| [range.start, range.end - 1]);
        let rows = rows.map(|row| PLACE[1] + u16::try_from(row).expect("small"));
        flush(&mut interface, [PLACE[0], PLACE[0] + SIZE[0] - 1], rows, band.bytes()).expect("mocks");
    });
    spi.done();
    pin.done();
}

/// An SPI device as those with DMA are: a few bytes go on the spot, and the transfer of more ends at its second poll.
struct Dma<'a> {
    spi: Spi<u8>,
    log: &'a RefCell<Vec<&'static str>>,
}

impl ErrorType for Dma<'_> {
    type Error = ErrorKind;
}

impl SpiDevice for Dma<'_> {
    async fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), ErrorKind> {
        let pixels = matches!(operations, [Operation::Write(bytes)] if bytes.len() > 4);
        if pixels {
            self.log.borrow_mut().push("begun");
            yield_now().await;
        }
        SpiDevice::transaction(&mut self.spi, operations).await?;
        if pixels {
            self.log.borrow_mut().push("sent");
        }
        Ok(())
    }
}

/// With the colours of two bands one is drawn while the other is on the wire: by one task, as on a board.
#[test]
fn lcd_async_sends_a_band_while_the_next_is_drawn() {
    use lcd_async::interface::SpiInterface;
    let mut wire = st7789();
    BANDS.iter().for_each(|(row, pixels)| wire.band(*row, pixels));
    let (mut spi, mut pin) = wire.mocks();
    let log = RefCell::default();
    let interface = SpiInterface::new(Dma { spi: spi.clone(), log: &log }, pin.clone());
    pollster::block_on(async {
        let model = lcd_async::models::ST7789;
        let mut delay = NoopDelay::new();
        let mut display = lcd_async::Builder::new(model, interface).init(&mut delay).await.expect("mocks");
        let (mut colors, mut depth) = ([[0; 8]; 2], [(); 8]);
        let [first, second] = &mut colors;
        let mut bands =
            PingPong::new(Rgb565Be, NoDepth, SIZE.map(u32::from), [first, second], &mut depth).expect("fits");
        while let Some(Turn { band, ready }) = bands.turn() {
            let sending = async {
                if let Some(Ready { rows, pixels }) = ready {
                    let (place, count) = ([PLACE[0], PLACE[1] + rows.start], rows.end - rows.start);
                    let bytes = bytemuck::cast_slice(pixels);
                    display.show_raw_data(place[0], place[1], SIZE[0], count, bytes).await.expect("mocks");
                }
            };
            let drawing = async {
                if let Some(mut band) = band {
                    band.clear(BACKGROUND);
                    band.scissor(2..3, 0..5).clear(BAR);
                    log.borrow_mut().push("drawn");
                }
            };
            join(sending, drawing).await;
        }
    });
    spi.done();
    pin.done();
    let overlapping = ["begun", "drawn", "sent"];
    assert_eq!(log.take(), [&["drawn"][..], &overlapping, &overlapping, &["begun", "sent"]].concat());
}
