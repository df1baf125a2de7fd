//! The demo on a board with an nRF52840, with the pins of Adafruit's Feather.
//!
//! | display | pin | function |
//! |---|---|---|
//! | SCL, SCK | P0.14 | any that is no low-frequency pin |
//! | SDA, MOSI | P0.13 | likewise |
//! | CS | P0.27 | |
//! | DC, RS | P0.26 | |
//! | RST | P0.06 | |
//! | TE | P0.07 | need not be wired |
//! | VCC, BLK | 3V3 | |

#![no_std]
#![no_main]

use alberti_demo::{Demo, FIXED};
use embassy_executor::Spawner;
use embassy_nrf::bind_interrupts;
use embassy_nrf::config::HfclkSource;
use embassy_nrf::gpio::{Input, Level, Output, OutputDrive, Pull};
use embassy_nrf::peripherals::SPI2;
use embassy_nrf::spim::{self, Config, Frequency, Spim};
use embassy_time::{Delay, Duration};
use panel::{Chip, Pace, Panel, Pins, PixelFormat};
use panic_halt as _;
use static_cell::ConstStaticCell;

bind_interrupts!(struct Interrupts {
    SPI2 => spim::InterruptHandler<SPI2>;
});

/// The time of a frame, if the core is quick enough for it.
const FRAME: Duration = Duration::from_hz(30);

static DEMO: ConstStaticCell<Demo> = ConstStaticCell::new(Demo::new());

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    let mut config = embassy_nrf::config::Config::default();
    config.hfclk_source = HfclkSource::ExternalXtal;
    let board = embassy_nrf::init(config);
    // SPIM3 alone reaches 32 MHz. But it may send wrong bytes while the core writes to the same block of RAM (anomaly
    // 198), as it does here. With a frame's changes at 8 MHz the bus is about as quick as the drawing.
    let mut config = Config::default();
    config.frequency = Frequency::M8;
    config.sck_drive = OutputDrive::HighDrive;
    config.mosi_drive = OutputDrive::HighDrive;
    let bus = Spim::new_txonly(board.SPI2, Interrupts, board.P0_14, board.P0_13, config);
    let pins = Pins {
        select: Output::new(board.P0_27, Level::High, OutputDrive::Standard),
        data: Output::new(board.P0_26, Level::High, OutputDrive::Standard),
        reset: Output::new(board.P0_06, Level::High, OutputDrive::Standard),
    };

    let tearing = Input::new(board.P0_07, Pull::Down);
    let pace = Pace::new(FRAME, tearing);
    let chip = Chip::St7789(PixelFormat::Rgb565);
    let Ok(mut panel) = Panel::new(chip, bus, pins, &mut Delay, pace).await else { return };
    let demo = DEMO.take();
    // Also with an FPU fixed point is the quicker.
    while demo.frame(FIXED, &mut panel).await.is_ok() {}
}
