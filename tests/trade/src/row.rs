//! The rows of the trade: a policy of a family on a scene, and how it is judged.

use crate::scenes::Scene;

/// Draws into the words of a picture: clears colour and depth, transforms all vertices, draws all triangles.
pub type Frame = Box<dyn FnMut(&mut [u32])>;

/// A triangle's number and texture coordinates at each pixel, by a policy.
pub type Places = Vec<Option<(u32, [f32; 2])>>;

/// The pixels of a picture of this size.
#[must_use]
pub fn pixels([width, height]: [u32; 2]) -> usize {
    width as usize * height as usize
}

/// The words of a picture as bytes.
#[must_use]
pub fn bytes(words: &[u32]) -> Vec<[u8; 4]> {
    words.iter().map(|word| word.to_ne_bytes()).collect()
}

/// What the picture of a row is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Judge {
    /// A ray through each pixel's centre in `f64`, with the nearest texel.
    Rays,
    /// 64 rays a pixel in `f64`, a bilinear filter at each, and the mean of their light.
    Area,
    /// The picture of the family's reference, which the tests hold to `f64`.
    Reference,
}

/// A policy on a scene.
pub struct Row {
    /// Its family's name.
    pub family: &'static str,
    /// The policy's, as its type is written.
    pub policy: String,
    /// The scene.
    pub scene: &'static Scene,
    /// Whether others of the family are measured as multiples of this one.
    pub reference: bool,
    /// The right picture.
    pub judge: Judge,
    /// Columns and rows.
    pub size: [u32; 2],
    /// Draws it.
    pub frame: Frame,
    /// Finds the texture coordinates, of families in which they differ.
    pub places: Option<Box<dyn Fn() -> Places>>,
}

impl Row {
    /// A row without texture coordinates.
    pub fn new(
        family: &'static str,
        policy: impl Into<String>,
        scene: &'static Scene,
        judge: Judge,
        (size, frame): ([u32; 2], Frame),
    ) -> Self {
        Self { family, policy: policy.into(), scene, reference: false, judge, size, frame, places: None }
    }

    /// The number of its pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        pixels(self.size)
    }

    /// The row that the others are measured by.
    #[must_use]
    pub fn as_reference(self) -> Self {
        Self { reference: true, ..self }
    }

    /// With its texture coordinates.
    #[must_use]
    pub fn with_places(self, places: impl Fn() -> Places + 'static) -> Self {
        Self { places: Some(Box::new(places)), ..self }
    }

    /// Its name in messages and in the table of numbers.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{}/{}/{}", self.family, self.scene.name, self.policy)
    }
}

impl std::fmt::Debug for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Row").field("name", &self.name()).field("judge", &self.judge).finish_non_exhaustive()
    }
}
