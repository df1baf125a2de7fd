//! The measurement.

use alberti_trade::families::FAMILIES;
use alberti_trade::frame::{PIXELS, bytes};
use std::time::Instant;

fn main() {
    for family in FAMILIES {
        for mut row in (family.rows)(family.name) {
            let mut pixels = vec![0; PIXELS];
            (row.frame)(&mut pixels);
            let start = Instant::now();
            (row.frame)(&mut pixels);
            let time = start.elapsed();
            println!("{} {:?}", row.name(), time);
            if let Some(folder) = std::env::args().nth(1) {
                let name = row.name().replace(['/', ' '], "_");
                let path = std::path::Path::new(&folder).join(format!("{name}.png"));
                let flat: Vec<u8> = bytes(&pixels).into_iter().flatten().collect();
                image::save_buffer(path, &flat, 640, 480, image::ColorType::Rgba8).unwrap();
            }
        }
    }
}
