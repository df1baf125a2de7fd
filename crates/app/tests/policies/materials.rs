//! Surfaces that the app puts together at run time are the library's materials of the same layers, with their types
//! named: colours and depths, bit for bit.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    reason = "small numbers"
)]

mod lights;
mod maps;
mod plain;
mod scene;
mod typed;
mod ways;

use scene::Scene;
use typed::Picture;

/// Pixels in which pictures differ at least: a case that draws what another does would test nothing.
const LEAST: usize = 60;

/// The app's pictures, with what is wrong with them.
#[derive(Default)]
struct Cases {
    drawn: Vec<(String, Picture)>,
    wrong: Vec<String>,
}

impl Cases {
    /// The app's picture of a scene is the expected one, and none of those before.
    fn check(&mut self, name: &str, scene: &Scene, expected: &Picture) {
        let found = Picture::of(scene);
        let off = found.differing(expected);
        if off > 0 {
            self.wrong.push(format!("{name}: {off} pixels"));
        }
        for (other, picture) in &self.drawn {
            let differing = found.differing(picture);
            if differing < LEAST {
                self.wrong.push(format!("{name} is {other} but for {differing} pixels"));
            }
        }
        self.drawn.push((name.to_owned(), found));
    }

    /// The end, with the number of cases.
    fn done(&self, count: usize) {
        assert!(self.wrong.is_empty(), "{:#?}", self.wrong);
        assert_eq!(self.drawn.len(), count);
    }
}
