//! The demo on a Raspberry Pi Pico, and its kin with an RP2040.
//!
//! | display | pin | function |
//! |---|---|---|
//! | SCL, SCK | GP18 | SPI0 SCK |
//! | SDA, MOSI | GP19 | SPI0 TX |
//! | CS | GP17 | |
//! | DC, RS | GP16 | |
//! | RST | GP20 | |
//! | TE | GP21 | need not be wired |
//! | VCC, BLK | 3V3 | |

#![no_std]
#![no_main]

use alberti_demo::{Demo, FIXED};
use embassy_executor::Spawner;
use embassy_rp::gpio::{Input, Level, Output, Pull};
use embassy_rp::peripherals::DMA_CH0;
use embassy_rp::spi::{Config, Spi};
use embassy_rp::{bind_interrupts, dma};
use embassy_time::{Delay, Duration};
use panel::{Chip, Pace, Panel, Pins, PixelFormat};
use panic_halt as _;
use static_cell::ConstStaticCell;

bind_interrupts!(struct Interrupts {
    DMA_IRQ_0 => dma::InterruptHandler<DMA_CH0>;
});

/// The time of a frame, if the core is quick enough for it.
const FRAME: Duration = Duration::from_hz(30);

static DEMO: ConstStaticCell<Demo> = ConstStaticCell::new(Demo::new());

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    // 125 MHz, of which the bus has half: as much as the display takes.
    let board = embassy_rp::init(Default::default());
    let mut config = Config::default();
    config.frequency = 62_500_000;
    let bus = Spi::new_txonly(board.SPI0, board.PIN_18, board.PIN_19, board.DMA_CH0, Interrupts, config);
    let pins = Pins {
        select: Output::new(board.PIN_17, Level::High),
        data: Output::new(board.PIN_16, Level::High),
        reset: Output::new(board.PIN_20, Level::High),
    };

    let tearing = Input::new(board.PIN_21, Pull::Down);
    let pace = Pace::new(FRAME, tearing);
    let chip = Chip::St7789(PixelFormat::Rgb565);
    let Ok(mut panel) = Panel::new(chip, bus, pins, &mut Delay, pace).await else { return };
    let demo = DEMO.take();
    // Without an FPU fixed point is the quicker.
    while demo.frame(FIXED, &mut panel).await.is_ok() {}
}
