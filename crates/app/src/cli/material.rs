//! The options that replace parts of every material.

use std::path::PathBuf;

use clap::Args;

use super::values::{color, range, share, shininess, strength};
use crate::scene::{EnvironmentKind, NormalSpace, Relief};

/// What every surface gets instead of what its material says.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Material")]
pub struct MaterialArgs {
    /// Image whose red, green and blue are the surface's normal, from -1 at 0 to 1 at 255; green points to growing v.
    #[arg(long, value_name = "FILE")]
    pub normal_map: Option<PathBuf>,

    /// Between which axes those normals are; needs --normal-map [default: tangent].
    #[arg(long, value_enum, value_name = "SPACE")]
    pub normal_space: Option<NormalSpace>,

    /// How steep they are, from 0, smooth, to 100; needs --normal-map [default: 1, as they are].
    #[arg(long, value_name = "X", allow_hyphen_values = true, value_parser = strength)]
    pub normal_strength: Option<f32>,

    /// Image of heights, black low and white high; 16-bit PNG keeps its 65536 steps.
    #[arg(long, value_name = "FILE")]
    pub height_map: Option<PathBuf>,

    /// What is made of the heights; needs --height-map [default: bump].
    #[arg(long, value_enum, value_name = "HOW")]
    pub relief: Option<Relief>,

    /// Heights of black and white, in units of the model; needs --height-map.
    ///
    /// The default goes over a fiftieth of the model's radius: from 0 on with bump and displacement, and up to 0 with
    /// all others, which press the surface in.
    #[arg(long, value_name = "LO,HI", allow_hyphen_values = true, value_parser = range)]
    pub height_range: Option<[f32; 2]>,

    /// Image of how much surrounding light arrives: red, from none at 0 to all at 255.
    #[arg(long, value_name = "FILE")]
    pub ao: Option<PathBuf>,

    /// Colour of highlights, as hexadecimal sRGB [default: the materials', else 404040].
    #[arg(long, value_name = "RRGGBB", allow_hyphen_values = true, value_parser = color)]
    pub specular: Option<[u8; 3]>,

    /// Exponent of highlights, or the two that --shininess-map goes between, from 0 to 65536 [default: the materials',
    /// else 1,32, of which the second counts where there is no map].
    #[arg(long, value_name = "N or LO,HI", allow_hyphen_values = true, value_parser = shininess)]
    pub shininess: Option<[f32; 2]>,

    /// Image of how sharp highlights are: red, from the least of --shininess at 0 to the greatest at 255.
    #[arg(long, value_name = "FILE")]
    pub shininess_map: Option<PathBuf>,

    /// Image of how wet the surface is, which makes it darker and its highlights sharper: red, from dry at 0 to 255.
    #[arg(long, value_name = "FILE")]
    pub wetness_map: Option<PathBuf>,

    /// Image of what the surface mirrors.
    #[arg(long, value_name = "FILE")]
    pub environment: Option<PathBuf>,

    /// How it shows all directions; needs --environment [default: lat-long].
    #[arg(long, value_enum, value_name = "KIND")]
    pub environment_kind: Option<EnvironmentKind>,

    /// How much of it is mirrored, from 0 to 1; needs --environment [default: 0.5].
    #[arg(long, value_name = "X", allow_hyphen_values = true, value_parser = share)]
    pub reflection: Option<f32>,
}
