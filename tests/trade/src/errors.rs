//! Errors of a row: of its picture beside the right one, and of its texture coordinates beside those of rays.

use crate::reference;
use crate::row::{Judge, Places, Row, bytes};
use crate::scenes::Scene;
use alberti_app::measure::{Comparison, Measures, percentile};
use alberti_app::scene::Image;
use alberti_oracle::ideal::Seen;
use std::collections::HashMap;
use std::rc::Rc;

/// The errors of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Texture coordinates against those of rays, in texels.
    pub texels: Option<Texels>,
    /// The picture against the right one.
    pub picture: Measures,
}

/// Errors of texture coordinates, in texels, at the pixels whose triangle is the right one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texels {
    /// The largest.
    pub largest: f64,
    /// The largest but for one in a thousand.
    pub most: f64,
}

/// A picture and what makes it wrong.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The row's picture.
    pub picture: Image,
    /// The right one.
    pub right: Rc<Image>,
    /// Their differences.
    pub comparison: Comparison,
    /// In numbers.
    pub errors: Errors,
}

/// Judges rows, and keeps the references that several of them share.
#[derive(Debug, Default)]
pub struct Court {
    pictures: HashMap<(&'static str, Judge), Rc<Image>>,
    points: HashMap<&'static str, Rc<Vec<Option<Seen>>>>,
}

impl Court {
    /// Draws all rows of a scene and compares them.
    ///
    /// # Panics
    /// Without a reference among the rows.
    pub fn judge(&mut self, rows: &mut [Row]) -> Vec<Judged> {
        let pictures: Vec<Image> = rows.iter_mut().map(picture).collect();
        let reference = rows.iter().position(|row| row.reference).expect("a reference");
        let own = Rc::new(pictures[reference].clone());
        let judged = rows.iter().zip(pictures).map(|(row, picture)| {
            let right = match row.judge {
                Judge::Reference => Rc::clone(&own),
                judge => self.right(row.scene, judge, row.size),
            };
            let texels = row.places.as_ref().map(|places| self.texels(row, &places()));
            let comparison = Comparison::new(&picture, &right).expect("pictures of one size");
            let errors = Errors { texels, picture: comparison.measures };
            Judged { picture, right, comparison, errors }
        });
        judged.collect()
    }

    /// The right picture of a scene.
    fn right(&mut self, scene: &'static Scene, judge: Judge, size: [u32; 2]) -> Rc<Image> {
        let picture = self.pictures.entry((scene.name, judge)).or_insert_with(|| {
            let texels = match judge {
                Judge::Area => reference::by_area(scene, size),
                Judge::Rays | Judge::Reference => reference::by_rays(scene, size),
            };
            Rc::new(image(size, texels))
        });
        Rc::clone(picture)
    }

    fn texels(&mut self, row: &Row, places: &Places) -> Texels {
        let points = self.points.entry(row.scene.name);
        let points = points.or_insert_with(|| Rc::new(reference::points(row.scene, row.size)));
        let sides = row.scene.sides().map(f64::from);
        let mut errors: Vec<f64> = places
            .iter()
            .zip(points.iter())
            .filter_map(|pair| match pair {
                (Some((triangle, uv)), Some(seen)) if *triangle == seen.triangle => {
                    let off = |axis: usize| (f64::from(uv[axis]) - seen.uv[axis]).abs() * sides[axis];
                    Some(off(0).max(off(1)))
                }
                _ => None,
            })
            .collect();
        assert!(errors.len() * 2 > points.iter().flatten().count(), "{}: another picture", row.name());
        let most = percentile(&errors, 999).unwrap_or_default();
        errors.sort_by(f64::total_cmp);
        Texels { largest: errors.last().copied().unwrap_or_default(), most }
    }
}

/// The picture that a row draws.
pub fn picture(row: &mut Row) -> Image {
    let mut words = vec![0; row.pixels()];
    (row.frame)(&mut words);
    image(row.size, bytes(&words))
}

fn image([width, height]: [u32; 2], texels: Vec<[u8; 4]>) -> Image {
    Image { width, height, texels }
}
