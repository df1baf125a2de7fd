//! The demo on a Nucleo-H743ZI, and others with an STM32H743.
//!
//! | display | pin | function |
//! |---|---|---|
//! | SCL, SCK | PA5 | SPI1 SCK |
//! | SDA, MOSI | PB5 | SPI1 MOSI |
//! | CS | PD14 | |
//! | DC, RS | PD15 | |
//! | RST | PE9 | |
//! | TE | PE11 | need not be wired |
//! | VCC, BLK | 3V3 | |

#![no_std]
#![no_main]

use alberti_demo::{Demo, FIXED};
use embassy_executor::Spawner;
use embassy_stm32::exti::{self, ExtiInput};
use embassy_stm32::gpio::{Level, Output, Pull, Speed};
use embassy_stm32::interrupt::typelevel::EXTI15_10;
use embassy_stm32::peripherals::DMA1_CH0;
use embassy_stm32::spi::{Config, Spi};
use embassy_stm32::time::Hertz;
use embassy_stm32::{bind_interrupts, dma, rcc};
use embassy_time::{Delay, Duration};
use panel::{Chip, Pace, Panel, Pins, PixelFormat};
use panic_halt as _;
use static_cell::ConstStaticCell;

bind_interrupts!(struct Interrupts {
    DMA1_STREAM0 => dma::InterruptHandler<DMA1_CH0>;
    EXTI15_10 => exti::InterruptHandler<EXTI15_10>;
});

/// The time of a frame, if the core is quick enough for it.
const FRAME: Duration = Duration::from_hz(30);

/// In the RAM that the DMA reads, as all statics are: see `memory.x`.
static DEMO: ConstStaticCell<Demo> = ConstStaticCell::new(Demo::new());

/// 400 MHz for the core and 114 MHz for the bus, of the internal oscillator's 64 MHz.
fn clocks() -> rcc::Config {
    let mut config = rcc::Config::new();
    config.pll1 = Some(rcc::Pll {
        source: rcc::PllSource::HSI,
        prediv: rcc::PllPreDiv::DIV4,
        mul: rcc::PllMul::MUL50,
        fracn: None,
        divp: Some(rcc::PllDiv::DIV2),
        divq: Some(rcc::PllDiv::DIV7),
        divr: None,
    });
    config.sys = rcc::Sysclk::PLL1_P;
    config.ahb_pre = rcc::AHBPrescaler::DIV2;
    config.apb1_pre = rcc::APBPrescaler::DIV2;
    config.apb2_pre = rcc::APBPrescaler::DIV2;
    config.apb3_pre = rcc::APBPrescaler::DIV2;
    config.apb4_pre = rcc::APBPrescaler::DIV2;
    config.voltage_scale = rcc::VoltageScale::Scale1;
    config
}

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    // The cache of instructions only: the DMA would not see what is in the cache of data.
    if let Some(mut core) = cortex_m::Peripherals::take() {
        core.SCB.enable_icache();
    }
    let mut config = embassy_stm32::Config::default();
    config.rcc = clocks();
    let board = embassy_stm32::init(config);
    // Half of what the PLL's second output gives: 57 MHz, and the display takes 62.5.
    let mut config = Config::default();
    config.frequency = Hertz::mhz(58);
    let bus = Spi::new_txonly(board.SPI1, board.PA5, board.PB5, board.DMA1_CH0, Interrupts, config);
    let pins = Pins {
        select: Output::new(board.PD14, Level::High, Speed::VeryHigh),
        data: Output::new(board.PD15, Level::High, Speed::VeryHigh),
        reset: Output::new(board.PE9, Level::High, Speed::Low),
    };

    let tearing = ExtiInput::new(board.PE11, board.EXTI11, Pull::Down, Interrupts);
    let pace = Pace::new(FRAME, tearing);
    let chip = Chip::St7789(PixelFormat::Rgb565);
    let Ok(mut panel) = Panel::new(chip, bus, pins, &mut Delay, pace).await else { return };
    let demo = DEMO.take();
    // Also with an FPU fixed point is the quicker.
    while demo.frame(FIXED, &mut panel).await.is_ok() {}
}
