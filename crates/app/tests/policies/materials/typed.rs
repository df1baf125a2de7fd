//! Pictures by types that are named. A stage is behind a pointer, so that one kernel serves all stages of a varying;
//! its colours are those of its own function for one sample.

use super::scene::{BACKGROUND, SIZE, Scene};
use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{Lanes, One, OneFixed};
use alberti::raster::color::{Blend, Blended};
use alberti::raster::{self, Differentiation};
use alberti::shaders::material::Framed;
use alberti::{
    ColorFormat, D16, D24, D32, DepthFormat, F32, F32Reversed, FragmentStage, Fragments, Interpolation, Mesh,
    NoDepth, Pass, Q16, ReadOnly, Rgba8, Rgba8888, Subpixel, Target, Varying, View,
};
use alberti_app::options;
use alberti_app::render::{any_depth, draw};
use alberti_app::scene::Vertex;
use std::marker::PhantomData;
use std::num::Wrapping;

const PIXELS: usize = (SIZE[0] * SIZE[1]) as usize;

/// Colours and depths, as words.
#[derive(PartialEq)]
pub(crate) struct Picture {
    color: Vec<u32>,
    depth: Vec<u32>,
}

impl Picture {
    /// The app's.
    pub(crate) fn of(scene: &Scene) -> Self {
        let format = any_depth(scene.options.depth);
        let (mut color, mut depth) = (vec![0; PIXELS], vec![format.farthest(); PIXELS]);
        let [width, height] = SIZE;
        let target = Target::new(Rgba8888, format, width, height, &mut color, &mut depth);
        let Scene { model, camera, options } = scene;
        draw(model, camera, options, &mut target.expect("fits"), &mut |_, _| {}).expect("a picture");
        if scene.options.depth == options::DepthFormat::None {
            depth.fill(0);
        }
        Self { color, depth }
    }

    /// The pixels that are not those of another picture.
    pub(crate) fn differing(&self, other: &Self) -> usize {
        let [mine, others] =
            [self, other].map(|picture| picture.color.iter().zip(&picture.depth).collect::<Vec<_>>());
        mine.iter().zip(&others).filter(|(a, b)| a != b).count()
    }
}

/// A depth format with the words by which `AnyDepth` stores the same.
pub(crate) trait Words: DepthFormat {
    fn word(stored: Self::Stored) -> u32;
}

macro_rules! words {
    ($($format:ty: |$stored:pat_param| $word:expr;)+) => {$(
        impl Words for $format {
            fn word($stored: Self::Stored) -> u32 {
                $word
            }
        }
    )+};
}
words! {
    F32: |z| z.to_bits();
    F32Reversed: |z| !z.to_bits();
    D16: |z| z.into();
    D24: |z| z;
    D32: |z| z;
    NoDepth: |()| 0;
}

/// A stage's function, in floats and in fixed point.
pub(crate) trait Shades<V: Varying> {
    fn float(&self, fragments: &Fragments<One, V>) -> Option<u32>;
    fn fixed(&self, fragments: &Fragments<OneFixed, V>) -> Option<u32>;
}

/// A stage that is compiled in both.
pub(crate) struct InBoth<S>(pub(crate) S);

/// One that is compiled in floats alone.
pub(crate) struct InFloats<S>(pub(crate) S);

fn kept<L: Lanes<U32 = Wrapping<u32>, Mask = bool>, V: Varying>(
    stage: &impl FragmentStage<V, Color = Rgba8>,
    fragments: &Fragments<L, V>,
) -> Option<u32> {
    let (word, kept) = stage.shade(fragments);
    kept.then_some(word.0)
}

impl<V: Varying, S: FragmentStage<V, Color = Rgba8>> Shades<V> for InBoth<S> {
    fn float(&self, fragments: &Fragments<One, V>) -> Option<u32> {
        kept(&self.0, fragments)
    }

    fn fixed(&self, fragments: &Fragments<OneFixed, V>) -> Option<u32> {
        kept(&self.0, fragments)
    }
}

impl<V: Varying, S: FragmentStage<V, Color = Rgba8>> Shades<V> for InFloats<S> {
    fn float(&self, fragments: &Fragments<One, V>) -> Option<u32> {
        kept(&self.0, fragments)
    }

    fn fixed(&self, _: &Fragments<OneFixed, V>) -> Option<u32> {
        unreachable!("a stage for floats alone")
    }
}

/// A stage behind a pointer, with its derivatives.
struct Pointed<'a, V, D> {
    stage: &'a dyn Shades<V>,
    derivatives: PhantomData<D>,
}

impl<V, D> Clone for Pointed<'_, V, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V, D> Copy for Pointed<'_, V, D> {}

impl<V: Varying, D: Differentiation> FragmentStage<V> for Pointed<'_, V, D> {
    type Color = Rgba8;
    type Derivatives = D;
    const WIDE: bool = false;

    fn shade<L: Lanes>(&self, fragments: &Fragments<L, V>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying, gradient, mask, place: [column, row] } = *fragments;
        let mut kept = 0;
        let mut shade = |k: usize| {
            if lanes.bits(mask) >> k & 1 == 0 {
                return 0;
            }
            let place = [column + k as i32, row];
            let word = if L::FIXED {
                let at = |number: L::Number| {
                    // Numbers in fixed point are in units of 2^-16.
                    let words = lanes.store_words(lanes.floor_scaled(number, 16));
                    Q16::from_bits(words.as_ref()[k].cast_signed())
                };
                let gradient = gradient.map(|bundle| V::map(&bundle, &at));
                let varying = V::map(&varying, &at);
                self.stage.fixed(&Fragments { lanes: OneFixed, varying, gradient, mask: true, place })
            } else {
                let at = |number: L::Number| lanes.store(number).as_ref()[k];
                let gradient = gradient.map(|bundle| V::map(&bundle, &at));
                let varying = V::map(&varying, &at);
                self.stage.float(&Fragments { lanes: One, varying, gradient, mask: true, place })
            };
            kept |= u32::from(word.is_some()) << k;
            word.unwrap_or(0)
        };
        let mut words = lanes.each(|_| 0);
        words.as_mut().iter_mut().enumerate().for_each(|(k, word)| *word = shade(k));
        (lanes.load_words(&words), mask & lanes.mask(kept))
    }
}

/// A vertex's place and attributes.
pub(crate) type Stage<'a, V> = &'a dyn Fn(&Vertex) -> (Vec3, V);

/// A picture under way.
pub(crate) struct Sheet<'s, Z: Words> {
    scene: &'s Scene,
    color: Vec<u32>,
    depth: Vec<Z::Stored>,
    format: Z,
}

impl<'s, Z: Words> Sheet<'s, Z> {
    pub(crate) fn new(scene: &'s Scene, format: Z) -> Self {
        let (color, depth) = (vec![Rgba8888.pixel(BACKGROUND); PIXELS], vec![format.farthest(); PIXELS]);
        Self { scene, color, depth, format }
    }

    /// A part by a stage in floats.
    pub(crate) fn paint<V: Varying, S: FragmentStage<V, Color = Rgba8>>(
        self,
        part: usize,
        vertex: Stage<'_, V>,
        stage: S,
    ) -> Self {
        self.paint_by::<V, S::Derivatives>((part, vertex), &InFloats(stage), alberti::Exact)
    }

    /// The same by any interpolation, with any derivatives.
    pub(crate) fn paint_by<V: Varying, D: Differentiation>(
        mut self,
        part: (usize, Stage<'_, V>),
        stage: &dyn Shades<V>,
        by: impl Interpolation,
    ) -> Self {
        let format = self.format;
        self.pass::<V, D, _, _, _>(part, stage, by, &self.scene.view(), (Rgba8888, format));
        self
    }

    /// The same through another projection.
    pub(crate) fn paint_through<V: Varying, S: FragmentStage<V, Color = Rgba8>>(
        mut self,
        vertex: Stage<'_, V>,
        stage: S,
        view: &View<impl alberti::Projection>,
    ) -> Self {
        let format = self.format;
        let stage = InFloats(stage);
        self.pass::<V, S::Derivatives, _, _, _>(
            (0, vertex),
            &stage,
            alberti::Exact,
            view,
            (Rgba8888, format),
        );
        self
    }

    /// A part that is mixed with what is behind it, and hides nothing.
    pub(crate) fn mix<V: Varying, S: FragmentStage<V, Color = Rgba8>>(
        mut self,
        part: usize,
        vertex: Stage<'_, V>,
        stage: S,
        by: impl Blend,
    ) -> Self {
        let formats = (Blended { format: Rgba8888, by }, ReadOnly(self.format));
        self.pass::<V, S::Derivatives, _, _, _>(
            (part, vertex),
            &InFloats(stage),
            alberti::Exact,
            &self.scene.view(),
            formats,
        );
        self
    }

    fn pass<V, D, P, Pr, Y>(
        &mut self,
        (part, vertex): (usize, Stage<'_, V>),
        stage: &dyn Shades<V>,
        by: P,
        view: &View<Pr>,
        (color, depth): (impl ColorFormat<Pixel = u32>, Y),
    ) where
        V: Varying,
        D: Differentiation,
        P: Interpolation,
        Pr: alberti::Projection,
        Y: raster::DepthFormat<Stored = Z::Stored>,
    {
        let ([width, height], options) = (SIZE, &self.scene.options);
        let target = Target::new(color, depth, width, height, &mut self.color, &mut self.depth);
        let mesh = Mesh::new(&self.scene.model.vertices, &self.scene.model.parts[part].triangles, vertex);
        let stage = Pointed::<V, D> { stage, derivatives: PhantomData };
        let subpixel = match options.policies.subpixel {
            options::Subpixel::Sub4 => Subpixel::Sub4,
            options::Subpixel::Sub8 => Subpixel::Sub8,
        };
        let cull = match options.cull {
            options::Cull::Back => alberti::Cull::Back,
            options::Cull::Front => alberti::Cull::Front,
            options::Cull::None => alberti::Cull::None,
        };
        let mut pass = Pass::new(view, &mesh, stage).interpolation(by).subpixel(subpixel).cull(cull);
        pass.draw_by(One, &mut target.expect("fits"));
    }

    pub(crate) fn picture(self) -> Picture {
        Picture { color: self.color, depth: self.depth.into_iter().map(Z::word).collect() }
    }
}

/// The one part by a stage in floats.
pub(crate) fn painted<V: Varying>(
    scene: &Scene,
    vertex: Stage<'_, V>,
    stage: impl FragmentStage<V, Color = Rgba8>,
) -> Picture {
    Sheet::new(scene, F32).paint(0, vertex, stage).picture()
}

pub(crate) fn place(v: &Vertex) -> Vec3 {
    Vec3::from_array(v.position)
}

pub(crate) fn uv(v: &Vertex) -> (Vec3, Vec2) {
    (place(v), Vec2::from_array(v.uv))
}

pub(crate) fn normal_uv(v: &Vertex) -> (Vec3, (Vec3, Vec2)) {
    (place(v), (Vec3::from_array(v.normal), Vec2::from_array(v.uv)))
}

/// The tangent frame as glTF has it.
pub(crate) fn framed(v: &Vertex) -> (Vec3, Framed) {
    let [x, y, z, handedness] = v.tangent;
    let (tangent, normal) = (Vec3::new(x, y, z), Vec3::from_array(v.normal));
    let axes = [tangent, normal.cross(tangent) * handedness, normal];
    (place(v), Framed { position: place(v), axes, uv: Vec2::from_array(v.uv) })
}
