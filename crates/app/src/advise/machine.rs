//! The machines that can be advised for, and what a way of drawing costs there.

use super::Work;
use super::candidate::Candidate;
use super::chips::{Chip, Off, chip};
use crate::error::Error;
use crate::options::{DepthFormat, Filter, Policies, RenderOptions, Subpixel};
use crate::scene::Model;
use clap::ValueEnum;

/// A machine that a scene is to be drawn on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Machine {
    /// This one, by one thread: its times are taken.
    #[default]
    Host,
    /// A Cortex-M4F: instructions, by a model.
    M4f,
    /// A Cortex-M0: instructions, by a model.
    M0,
    /// A RISC-V core of 32 bits without floating point: instructions, by a model.
    Rv32,
}

impl Machine {
    /// Its name among the options and in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Host => "host",
            Self::M4f => "m4f",
            Self::M0 => "m0",
            Self::Rv32 => "rv32",
        }
    }

    /// Whether costs come from a model instead of a clock.
    #[must_use]
    pub fn is_chip(self) -> bool {
        self != Self::Host
    }
}

/// The cost of a frame, and of what has to be there for it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Milliseconds on the host, instructions on chips.
    pub frame: f64,
    /// Bytes of code; 0 on the host.
    pub flash: f64,
    /// Bytes of the two buffers, a slot for each vertex and, on chips, the stack.
    pub ram: f64,
}

/// Bytes of a vertex that was transformed: of one with texture coordinates, which are words on every machine.
const SLOT: f64 = 32.0;

/// Costs on a machine.
#[derive(Debug)]
pub(super) struct Costs {
    chip: Option<Chip>,
}

impl Costs {
    /// # Errors
    /// Options that the model of a chip does not know.
    pub(super) fn new(machine: Machine, options: &RenderOptions) -> Result<Self, Error> {
        if machine == Machine::Host {
            return Ok(Self { chip: None });
        }
        if matches!(options.filter, Filter::Anisotropic(_)) {
            return Err(Error::new("an anisotropic filter", "nearest, bilinear or trilinear")
                .place("--filter")
                .hint("chips are advised on with these"));
        }
        Ok(Self { chip: Some(chip(machine)?) })
    }

    /// The cost on a chip of a frame with this work, if there is a chip, and it can draw so.
    pub(super) fn of(&self, candidate: Candidate, options: &RenderOptions, work: &Work) -> Option<Cost> {
        let known = self.chip.as_ref()?.cost(candidate, options.filter, options.policies.lod)?;
        Some(Cost {
            frame: known.frame(work),
            flash: known.flash,
            ram: self.ram(candidate, options, work) + known.stack,
        })
    }

    /// How far costs are off, of a chip.
    pub(super) fn off(&self) -> Option<Off> {
        self.chip.as_ref()?.off()
    }

    /// Whether it can be drawn so.
    pub(super) fn has(&self, candidate: Candidate, options: &RenderOptions) -> bool {
        let RenderOptions { filter, policies, .. } = *options;
        self.chip.as_ref().is_none_or(|chip| chip.cost(candidate, filter, policies.lod).is_some())
    }

    /// Bytes of buffers and vertices.
    pub(super) fn ram(&self, candidate: Candidate, options: &RenderOptions, work: &Work) -> f64 {
        let pixels = f64::from(options.width) * f64::from(options.height);
        pixels * (self.pixel() + depth_bytes(candidate.depth)) + SLOT * work.vertices
    }

    /// Bytes of a pixel's colour: RGB565 on chips.
    fn pixel(&self) -> f64 {
        if self.chip.is_some() { 2.0 } else { 4.0 }
    }

    /// Bytes of a texel, which is in flash on chips.
    pub(super) fn texel(&self) -> f64 {
        self.pixel()
    }
}

/// The places where a baked mesh is lit from one direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LitAt {
    /// Nowhere.
    Nowhere,
    /// At each pixel, on a normal that is interpolated.
    Pixels,
    /// At each vertex: the texels of the target's format get it as it is there.
    Vertices,
}

/// The instructions that a frame of a baked mesh with this work takes on a chip. Beside them is how far such estimates
/// are off mostly, in percent. Light at vertices has prices in fixed point alone.
///
/// # Errors
/// The chip has no such way of drawing.
pub fn baked_on_chip(
    machine: Machine,
    options: &RenderOptions,
    work: &Work,
    lit: LitAt,
) -> Result<(f64, f64), Error> {
    let costs = Costs::new(machine, options)?;
    let Policies { interpolation, arithmetic, subpixel, lod, .. } = options.policies;
    let candidate = Candidate { interpolation, arithmetic, subpixel, depth: options.depth };
    let chip = costs.chip.as_ref();
    let cost = chip.and_then(|chip| chip.baked(candidate, options.filter, lod, lit)).ok_or_else(|| {
        let found = format!("{} on {}", candidate.command_line(), machine.name());
        Error::new(found, "policies that the model of chips knows").hint("try --profile mcu")
    })?;
    Ok((cost.frame(work), costs.off().map_or(0.0, |off| off.most.max(off.baked))))
}

/// Bytes of a pixel's depth.
pub(crate) fn depth_bytes(depth: DepthFormat) -> f64 {
    match depth {
        DepthFormat::F32 | DepthFormat::F32Reversed | DepthFormat::U32 | DepthFormat::U24 => 4.0,
        DepthFormat::U16 => 2.0,
        DepthFormat::None => 0.0,
    }
}

/// Bits of a grid.
pub(super) fn subpixel_bits(subpixel: Subpixel) -> u32 {
    match subpixel {
        Subpixel::Sub4 => 4,
        Subpixel::Sub8 => 8,
    }
}

/// The texels of all images and heights that a model's surfaces name.
pub(super) fn texels(model: &Model) -> f64 {
    let mut images = vec![false; model.textures.len()];
    let mut heights = vec![false; model.heights.len()];
    let mark = |used: &mut Vec<bool>, index: usize| {
        if let Some(used) = used.get_mut(index) {
            *used = true;
        }
    };
    for part in &model.parts {
        let mut detail = part.detail.clone();
        let own = part.texture;
        own.into_iter()
            .chain(detail.images_mut().map(|index| *index))
            .for_each(|index| mark(&mut images, index));
        if let Some(map) = part.detail.height {
            mark(&mut heights, map.heights);
        }
    }
    let sizes = model.textures.iter().map(|image| [image.width, image.height]).zip(images);
    let all = sizes.chain(model.heights.iter().map(|image| [image.width, image.height]).zip(heights));
    all.filter(|(_, used)| *used).map(|([width, height], _)| f64::from(width) * f64::from(height)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Detail, HeightImage, HeightMap, Image, Part, Relief};

    #[test]
    fn a_slot_is_as_large_as_the_librarys() {
        let bytes = u32::try_from(size_of::<alberti::Slot<alberti::glam::Vec2>>()).expect("few");
        assert_eq!(f64::from(bytes), SLOT);
    }

    #[test]
    fn images_count_once_and_only_if_something_names_them() {
        let image = |width, height| Image { width, height, texels: vec![] };
        let height =
            HeightMap { heights: 0, wrap: None, relief: Relief::Bump, range: [0.0; 2], extent: [1.0; 2] };
        let part = Part {
            texture: Some(1),
            detail: Detail { height: Some(height), ..Detail::default() },
            ..Part::default()
        };
        let model = Model {
            parts: vec![part.clone(), Part { texture: Some(1), ..Part::default() }],
            textures: vec![image(512, 512).into(), image(16, 8).into()],
            heights: vec![HeightImage { width: 4, height: 2, heights: vec![] }.into()],
            ..Model::default()
        };
        assert_eq!(texels(&model), 128.0 + 8.0);
    }
}
