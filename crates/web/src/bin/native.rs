//! The pictures of the page without a browser, one sample at a time.
//!
//! ```text
//! native hashes    a line for each station and set of parameters: its size, the parameters, the hash of its pixels
//! native times     a line for each station: the milliseconds of a picture of 640x480, and its hash
//! ```
//!
//! Lines are JSON, for the driver.

use alberti_web::{Fault, PARAMETERS, Page, Parameters, Station, hash};
use std::process::ExitCode;
use std::time::Instant;

/// A station's size on the page, and sets of its controls' positions, the first of them those at which the page begins.
struct Case {
    station: Station,
    size: [u32; 2],
    sets: &'static [&'static [f32]],
}

const CASES: [Case; 8] = [
    Case {
        station: Station::Affine,
        size: [640, 320],
        sets: &[
            &[4.0, 6.0, 35.0, 0.0],
            &[9.5, 4.0, 60.0, 0.0],
            &[2.3, 3.0, 10.0, 1.0],
            &[20.0, 6.0, 90.0, 1.0],
        ],
    },
    Case {
        station: Station::Depth,
        size: [640, 360],
        sets: &[
            &[-2.0, 3.0, 0.0, -2.5],
            &[-2.5, 5.0, 1.0, -3.0],
            &[-1.5, 4.0, 2.0, -3.5],
            &[-3.0, 6.0, 3.0, -4.0],
        ],
    },
    Case {
        station: Station::Pipeline,
        size: [320, 240],
        sets: &[
            &[1.0, 0.0, 0.0, 1.2, 55.0, 1.0, 6.0],
            &[3.0, 0.8, 0.3, 2.4, 75.0, 1.5, 6.0],
            &[6.0, -1.1, -0.5, -1.0, -40.0, 0.4, 5.0],
        ],
    },
    Case {
        station: Station::Mipmaps,
        size: [640, 480],
        sets: &[
            &[3.0, 3.0, 0.0, 0.6, 12.0, 0.0],
            &[0.0, 3.0, 0.0, 1.0, 20.0, 0.0],
            &[1.0, 3.0, 0.0, 0.4, 5.0, 0.0],
            &[2.0, 3.0, -1.0, 0.8, 12.0, 1.0],
            &[3.0, 1.0, 0.5, 0.3, 30.0, 1.0],
        ],
    },
    Case {
        station: Station::Relief,
        size: [640, 480],
        sets: &[
            &[6.0, 0.06, 40.0, 16.0, -0.6, 0.5, 0.7],
            &[0.0, 0.06, 40.0, 24.0, 0.6, 0.5, 0.7],
            &[1.0, 0.1, 20.0, 24.0, -0.2, 0.2, 0.5],
            &[2.0, 0.04, -30.0, 24.0, 0.3, -0.5, 0.9],
            &[3.0, 0.05, 55.0, 24.0, 0.9, 0.1, 1.5],
            &[4.0, 0.05, 65.0, 24.0, 0.9, 0.1, 1.5],
            &[5.0, 0.12, 50.0, 8.0, 0.0, 0.8, 0.4],
            &[7.0, 0.12, 50.0, 24.0, 0.0, 0.8, 0.4],
        ],
    },
    Case {
        station: Station::Projector,
        size: [640, 480],
        sets: &[&[68.0, 2.6, 30.0, 0.0, 46.0], &[20.0, 1.4, 44.0, 1.0, 60.0], &[45.0, 3.6, 18.0, 1.0, 30.0]],
    },
    Case {
        station: Station::Frames,
        size: [640, 480],
        sets: &[
            &[0.0, 32.0, 0.12, 0.18, 0.0, 0.0, 30.0],
            &[1.0, 12.0, 0.3, 0.6, 1.0, 0.0, 80.0],
            &[2.0, 20.0, 0.7, 0.4, 1.0, 1.0, 160.0],
        ],
    },
    Case {
        station: Station::Model,
        size: [640, 480],
        sets: &[
            &[25.0, 20.0, 1.0, 1.0, 35.0],
            &[140.0, -30.0, 1.6, 2.0, -60.0],
            &[270.0, 60.0, 0.7, 0.5, 100.0],
        ],
    },
];

/// The positions, and zeros for controls that are not there.
fn parameters(set: &[f32]) -> Parameters {
    let mut parameters = [0.0; PARAMETERS];
    parameters[..set.len()].copy_from_slice(set);
    parameters
}

fn hashes(page: &mut Page) -> Result<(), Fault> {
    for Case { station, size, sets } in &CASES {
        for set in *sets {
            page.draw(*station, *size, &parameters(set))?;
            let (name, hash) = (station.name(), hash(page.canvas.pixels()));
            println!(r#"{{"station":"{name}","size":{size:?},"parameters":{set:?},"hash":"{hash:016x}"}}"#);
        }
    }
    Ok(())
}

/// The least time of eleven pictures: other programs only add to it.
fn times(page: &mut Page) -> Result<(), Fault> {
    for Case { station, sets, .. } in &CASES {
        let mut times = Vec::new();
        for _ in 0..11 {
            let begin = Instant::now();
            page.draw(*station, [640, 480], &parameters(sets[0]))?;
            times.push(begin.elapsed().as_secs_f64() * 1000.0);
        }
        times.sort_by(f64::total_cmp);
        let (name, set, hash) = (station.name(), sets[0], hash(page.canvas.pixels()));
        println!(
            r#"{{"station":"{name}","size":[640,480],"parameters":{set:?},"ms":{:.3},"hash":"{hash:016x}"}}"#,
            times[0]
        );
    }
    Ok(())
}

fn main() -> ExitCode {
    let mut page = Page::new();
    let done = match std::env::args().nth(1).as_deref() {
        Some("hashes") => hashes(&mut page),
        Some("times") => times(&mut page),
        _ => Err(Fault("expected `hashes` or `times`".into())),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("native: {error}");
            ExitCode::FAILURE
        }
    }
}
