//! The demo on a board with an STM32F411, as the "Black Pill" is one.
//!
//! | display | pin | function |
//! |---|---|---|
//! | SCL, SCK | PA5 | SPI1 SCK |
//! | SDA, MOSI | PA7 | SPI1 MOSI |
//! | CS | PA4 | |
//! | DC, RS | PB0 | |
//! | RST | PB1 | |
//! | TE | PB10 | need not be wired |
//! | VCC, BLK | 3V3 | |

#![no_std]
#![no_main]

use alberti_demo::{Demo, FIXED};
use embassy_executor::Spawner;
use embassy_stm32::exti::{self, ExtiInput};
use embassy_stm32::gpio::{Level, Output, Pull, Speed};
use embassy_stm32::interrupt::typelevel::EXTI15_10;
use embassy_stm32::peripherals::DMA2_CH3;
use embassy_stm32::spi::{Config, Spi};
use embassy_stm32::time::Hertz;
use embassy_stm32::{bind_interrupts, dma, rcc};
use embassy_time::{Delay, Duration};
use panel::{Chip, Pace, Panel, Pins, PixelFormat};
use panic_halt as _;
use static_cell::ConstStaticCell;

bind_interrupts!(struct Interrupts {
    DMA2_STREAM3 => dma::InterruptHandler<DMA2_CH3>;
    EXTI15_10 => exti::InterruptHandler<EXTI15_10>;
});

/// The time of a frame, if the core is quick enough for it.
const FRAME: Duration = Duration::from_hz(30);

static DEMO: ConstStaticCell<Demo> = ConstStaticCell::new(Demo::new());

/// 100 MHz of the crystal's 25 MHz.
fn clocks() -> rcc::Config {
    let mut config = rcc::Config::new();
    config.hse = Some(rcc::Hse { freq: Hertz::mhz(25), mode: rcc::HseMode::Oscillator });
    config.pll_src = rcc::PllSource::HSE;
    config.pll = Some(rcc::Pll {
        prediv: rcc::PllPreDiv::DIV25,
        mul: rcc::PllMul::MUL200,
        divp: Some(rcc::PllPDiv::DIV2),
        divq: None,
        divr: None,
    });
    config.sys = rcc::Sysclk::PLL1_P;
    config.apb1_pre = rcc::APBPrescaler::DIV2;
    config
}

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    let mut config = embassy_stm32::Config::default();
    config.rcc = clocks();
    let board = embassy_stm32::init(config);
    // Half of the clock, which is the most that it has.
    let mut config = Config::default();
    config.frequency = Hertz::mhz(50);
    let bus = Spi::new_txonly(board.SPI1, board.PA5, board.PA7, board.DMA2_CH3, Interrupts, config);
    let pins = Pins {
        select: Output::new(board.PA4, Level::High, Speed::VeryHigh),
        data: Output::new(board.PB0, Level::High, Speed::VeryHigh),
        reset: Output::new(board.PB1, Level::High, Speed::Low),
    };

    let tearing = ExtiInput::new(board.PB10, board.EXTI10, Pull::Down, Interrupts);
    let pace = Pace::new(FRAME, tearing);
    let chip = Chip::St7789(PixelFormat::Rgb565);
    let Ok(mut panel) = Panel::new(chip, bus, pins, &mut Delay, pace).await else { return };
    let demo = DEMO.take();
    // Also with an FPU fixed point is the quicker.
    while demo.frame(FIXED, &mut panel).await.is_ok() {}
}
