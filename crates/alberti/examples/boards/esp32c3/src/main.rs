//! The demo on a board with an ESP32-C3.
//!
//! | display | pin | function |
//! |---|---|---|
//! | SCL, SCK | GPIO6 | SPI2 CLK, without a detour by the matrix of pins |
//! | SDA, MOSI | GPIO7 | SPI2 D, likewise |
//! | CS | GPIO10 | |
//! | DC, RS | GPIO4 | |
//! | RST | GPIO5 | |
//! | TE | GPIO3 | need not be wired |
//! | VCC, BLK | 3V3 | |

#![no_std]
#![no_main]

use alberti_demo::{Demo, FIXED, ROWS};
use embassy_executor::Spawner;
use embassy_time::{Delay, Duration};
use esp_hal::clock::CpuClock;
use esp_hal::dma::{DmaRxBuf, DmaTxBuf};
use esp_hal::gpio::{Input, InputConfig, Level, Output, OutputConfig, Pull};
use esp_hal::interrupt::software::SoftwareInterruptControl;
use esp_hal::spi::master::{Config, Spi};
use esp_hal::time::Rate;
use esp_hal::timer::timg::TimerGroup;
use panel::{Chip, Pace, Panel, Pins, PixelFormat, WIDTH};
use panic_halt as _;
use static_cell::ConstStaticCell;

// The boot loader reads it.
esp_bootloader_esp_idf::esp_app_desc!();

/// The bytes of a band.
const BAND: usize = 2 * WIDTH as usize * ROWS as usize;

/// The time of a frame, if the core is quick enough for it.
const FRAME: Duration = Duration::from_hz(30);

static DEMO: ConstStaticCell<Demo> = ConstStaticCell::new(Demo::new());

#[esp_rtos::main]
async fn main(_spawner: Spawner) {
    let board = esp_hal::init(esp_hal::Config::default().with_cpu_clock(CpuClock::max()));
    let interrupts = SoftwareInterruptControl::new(board.SW_INTERRUPT);
    esp_rtos::start(TimerGroup::new(board.TIMG0).timer0, interrupts.software_interrupt0);

    // The most that the bus has. The display's data sheet ends at 62.5 MHz, and most take this; the next step down is
    // 40 MHz.
    let config = Config::default().with_frequency(Rate::from_mhz(80));
    // A transfer is of a copy, which is made before it begins.
    let (received, received_list, sent, sent_list) = esp_hal::dma_buffers!(4, BAND);
    let (Ok(bus), Ok(received), Ok(sent)) = (
        Spi::new(board.SPI2, config),
        DmaRxBuf::new(received_list, received),
        DmaTxBuf::new(sent_list, sent),
    ) else {
        return;
    };
    let bus = bus.with_sck(board.GPIO6).with_mosi(board.GPIO7);
    let bus = bus.with_dma(board.DMA_CH0).with_buffers(received, sent).into_async();
    let pins = Pins {
        select: Output::new(board.GPIO10, Level::High, OutputConfig::default()),
        data: Output::new(board.GPIO4, Level::High, OutputConfig::default()),
        reset: Output::new(board.GPIO5, Level::High, OutputConfig::default()),
    };

    let tearing = Input::new(board.GPIO3, InputConfig::default().with_pull(Pull::Down));
    let pace = Pace::new(FRAME, tearing);
    let chip = Chip::St7789(PixelFormat::Rgb565);
    let Ok(mut panel) = Panel::new(chip, bus, pins, &mut Delay, pace).await else { return };
    let demo = DEMO.take();
    // Without an FPU fixed point is the quicker.
    while demo.frame(FIXED, &mut panel).await.is_ok() {}
}
