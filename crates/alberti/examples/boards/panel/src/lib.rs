//! Displays of 320x240 pixels, and the driver of those with an ST7789 or an ILI9341 behind a serial bus.
//!
//! A transfer begins when its future is first polled, so that one can draw while it runs. For this the few bytes before
//! the pixels are sent on the spot, and only the pixels by DMA.

#![no_std]

mod pace;
#[cfg(test)]
mod tests;

pub use pace::Pace;

use core::convert::Infallible;
use core::ops::Range;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::SpiBus;
use embedded_hal_async::delay::DelayNs;
use embedded_hal_async::digital::Wait;
use embedded_hal_async::spi::SpiBus as Transfers;

/// Columns of a display.
pub const WIDTH: u16 = 320;
/// Rows of a display.
pub const HEIGHT: u16 = 240;

/// A display, and how it is reached.
#[allow(async_fn_in_trait, reason = "boards await on the spot, and no thread is there to send it to")]
pub trait Display {
    /// A failure of the bus.
    type Error;

    /// Waits until a frame may begin: for the display's tearing-effect pin, a timer, or both.
    async fn begin(&mut self) -> Result<(), Self::Error>;

    /// Sends a rectangle of the frame, neither of whose ranges is empty: its pixels row by row, without those beside.
    async fn send(&mut self, columns: Range<u16>, rows: Range<u16>, bytes: &[u8]) -> Result<(), Self::Error>;
}

/// The chip that drives the glass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chip {
    /// Most often with a glass that shows colours inverted.
    St7789(PixelFormat),
    /// With blue and red exchanged. It has pixels of 16 bits, which it gets here, and of 18, but none of 12.
    Ili9341,
}

/// Pixels as they are sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelFormat {
    /// Two bytes a pixel, RRRRRGGG GGGBBBBB.
    Rgb565,
    /// Three bytes for two pixels, RRRRGGGG BBBBRRRR GGGGBBBB. A rectangle begins and ends at even columns, as the data
    /// sheet does not say what becomes of a pixel alone.
    Rgb444,
}

/// The pins beside the bus.
#[derive(Debug)]
pub struct Pins<P> {
    /// Chip select, low while the display listens: always, as it has the bus for itself.
    pub select: P,
    /// Low for commands, high for data.
    pub data: P,
    /// Low to reset.
    pub reset: P,
}

/// A display behind a bus, whose frames are paced.
#[derive(Debug)]
pub struct Panel<B, P, T> {
    bus: B,
    pins: Pins<P>,
    pace: Pace<T>,
    /// Those that the display takes pixels for.
    columns: Range<u16>,
}

impl<B, P, T> Panel<B, P, T>
where
    B: SpiBus + Transfers,
    P: OutputPin<Error = Infallible>,
    T: Wait,
{
    /// Wakes the display, in landscape, with its tearing-effect line on.
    ///
    /// # Errors
    /// Those of the bus.
    pub async fn new(
        chip: Chip,
        bus: B,
        pins: Pins<P>,
        delay: &mut impl DelayNs,
        pace: Pace<T>,
    ) -> Result<Self, B::Error> {
        let mut panel = Self { bus, pins, pace, columns: 0..0 };
        let Ok(()) = panel.pins.select.set_low();
        let Ok(()) = panel.pins.reset.set_low();
        delay.delay_ms(10).await;
        let Ok(()) = panel.pins.reset.set_high();
        delay.delay_ms(120).await;
        panel.command(command::SLEEP_OUT, &[])?;
        delay.delay_ms(120).await;
        let (orientation, inversion, format) = match chip {
            // Rows and columns exchanged, then columns turned round, or blue before red.
            Chip::St7789(format) => (0x60, command::INVERTED, format),
            Chip::Ili9341 => (0x28, command::NOT_INVERTED, PixelFormat::Rgb565),
        };
        let (code, bits) = match format {
            PixelFormat::Rgb565 => (0x55, 16),
            PixelFormat::Rgb444 => (0x53, 12),
        };
        panel.command(command::PIXEL_FORMAT, &[code])?;
        panel.command(command::ORIENTATION, &[orientation])?;
        panel.command(inversion, &[])?;
        // Between frames only, not between lines.
        panel.command(command::TEARING_EFFECT, &[0])?;
        panel.blank(bits)?;
        panel.command(command::DISPLAY_ON, &[])?;
        Ok(panel)
    }

    /// Clears the display's memory, which holds noise, by pixels of so many bits.
    fn blank(&mut self, bits: usize) -> Result<(), B::Error> {
        self.window(0..WIDTH, 0..HEIGHT)?;
        // In pieces that also a DMA takes which cannot read flash, and copies them on the stack.
        const PIECE: usize = 128;
        for _ in 0..bits * usize::from(WIDTH) * usize::from(HEIGHT) / (8 * PIECE) {
            SpiBus::write(&mut self.bus, &[0; PIECE])?;
        }
        SpiBus::flush(&mut self.bus)
    }

    /// Has the display take what follows for pixels of this rectangle.
    fn window(&mut self, columns: Range<u16>, rows: Range<u16>) -> Result<(), B::Error> {
        if columns != self.columns {
            self.command(command::COLUMNS, &ends(&columns))?;
            self.columns = columns;
        }
        self.command(command::ROWS, &ends(&rows))?;
        self.command(command::PIXELS, &[])
    }

    /// Sends a command and its data, and leaves the display listening for more data.
    fn command(&mut self, command: u8, data: &[u8]) -> Result<(), B::Error> {
        let Ok(()) = self.pins.data.set_low();
        SpiBus::write(&mut self.bus, &[command])?;
        SpiBus::flush(&mut self.bus)?;
        let Ok(()) = self.pins.data.set_high();
        if !data.is_empty() {
            SpiBus::write(&mut self.bus, data)?;
            SpiBus::flush(&mut self.bus)?;
        }
        Ok(())
    }
}

impl<B, P, T> Display for Panel<B, P, T>
where
    B: SpiBus + Transfers,
    P: OutputPin<Error = Infallible>,
    T: Wait,
{
    type Error = B::Error;

    async fn begin(&mut self) -> Result<(), B::Error> {
        self.pace.next().await;
        Ok(())
    }

    async fn send(&mut self, columns: Range<u16>, rows: Range<u16>, bytes: &[u8]) -> Result<(), B::Error> {
        self.window(columns, rows)?;
        Transfers::write(&mut self.bus, bytes).await?;
        Transfers::flush(&mut self.bus).await
    }
}

/// The first and the last of a range, as the display wants them.
fn ends(range: &Range<u16>) -> [u8; 4] {
    let [[a, b], [c, d]] = [range.start, range.end - 1].map(u16::to_be_bytes);
    [a, b, c, d]
}

/// The commands that both chips share.
mod command {
    pub(crate) const SLEEP_OUT: u8 = 0x11;
    pub(crate) const NOT_INVERTED: u8 = 0x20;
    pub(crate) const INVERTED: u8 = 0x21;
    pub(crate) const DISPLAY_ON: u8 = 0x29;
    pub(crate) const COLUMNS: u8 = 0x2a;
    pub(crate) const ROWS: u8 = 0x2b;
    pub(crate) const PIXELS: u8 = 0x2c;
    pub(crate) const TEARING_EFFECT: u8 = 0x35;
    pub(crate) const ORIENTATION: u8 = 0x36;
    pub(crate) const PIXEL_FORMAT: u8 = 0x3a;
}
