//! Options that mean nothing without others.

use crate::cli::{Projection, RenderArgs};
use crate::error::{Error, quote};
use crate::scene::{Detail, Model, Part, Relief};

/// An option that does nothing without another is a mistake. What is said of maps may be meant for those of a model.
///
/// # Errors
/// There is one.
pub(crate) fn check(arguments: &RenderArgs) -> Result<(), Error> {
    let RenderArgs { projector, projector_eye, projector_target, projector_fov, .. } = arguments;
    let together = [
        ("--projector", projector.is_some()),
        ("--projector-eye", projector_eye.is_some()),
        ("--projector-target", projector_target.is_some()),
    ];
    let names = |with: bool| together.into_iter().filter(move |o| o.1 == with).map(|o| o.0);
    let missing = names(false).collect::<Vec<_>>().join(" and ");
    let given = names(true).next().or(projector_fov.map(|_| "--projector-fov"));
    if let Some(option) = given
        && !missing.is_empty()
    {
        let expected = format!("all three of {}", together.map(|o| o.0).join(", "));
        return Err(Error::new(format!("it without {missing}"), expected).place(option));
    }
    let material = &arguments.material;
    let with_map = |map: bool, name: &'static str, options: &[(&'static str, bool)]| {
        let given = options.iter().filter(|(_, given)| *given && !map);
        given.map(|&(option, _)| (option, name)).next()
    };
    let of_model = arguments.model.is_some();
    let lonely = [
        with_map(
            arguments.projection == Some(Projection::Parallel),
            "--projection parallel",
            &[("--view-height", arguments.view_height.is_some())],
        ),
        with_map(
            material.normal_map.is_some() || of_model,
            "--normal-map",
            &[
                ("--normal-space", material.normal_space.is_some()),
                ("--normal-strength", material.normal_strength.is_some()),
            ],
        ),
        with_map(
            material.height_map.is_some() || of_model,
            "--height-map",
            &[("--relief", material.relief.is_some()), ("--height-range", material.height_range.is_some())],
        ),
        with_map(
            material.environment.is_some() || of_model,
            "--environment",
            &[
                ("--environment-kind", material.environment_kind.is_some()),
                ("--reflection", material.reflection.is_some()),
            ],
        ),
    ];
    match lonely.into_iter().flatten().next() {
        Some((option, partner)) => {
            Err(Error::new(format!("it without {partner}"), "both, or neither").place(option))
        }
        None => Ok(()),
    }
}

/// What is said of maps that no part of a model has is a mistake as well.
///
/// # Errors
/// There is one.
pub(crate) fn check_maps(arguments: &RenderArgs, model: &Model) -> Result<(), Error> {
    let material = &arguments.material;
    let any = |has: fn(&Detail) -> bool| model.parts.iter().any(|part| has(&part.detail));
    let (normal, height, environment) =
        (any(|d| d.normal.is_some()), any(|d| d.height.is_some()), any(|d| d.environment.is_some()));
    let said = [
        ("--normal-space", material.normal_space.is_some(), normal, "a normal map"),
        ("--normal-strength", material.normal_strength.is_some(), normal, "a normal map"),
        ("--relief", material.relief.is_some(), height, "a height map"),
        ("--height-range", material.height_range.is_some(), height, "a height map"),
        ("--environment-kind", material.environment_kind.is_some(), environment, "an environment"),
        ("--reflection", material.reflection.is_some(), environment, "an environment"),
    ];
    match said.into_iter().find(|(_, given, there, _)| *given && !there) {
        Some((option, _, _, map)) => {
            Err(Error::new(format!("a model without {map}"), "one that it can be said of").place(option))
        }
        None => Ok(()),
    }
}

/// What to say of heights that are not used, as a surface's normals are those of its normal map.
pub(crate) fn unused_heights(model: &Model) -> Option<Error> {
    let unused = |part: &&Part| {
        let bump = part.detail.height.is_some_and(|height| height.relief == Relief::Bump);
        bump && part.detail.normal.is_some()
    };
    let part = model.parts.iter().find(unused)?;
    let of =
        if part.name.is_empty() { String::new() } else { format!(" of {}", quote(part.name.as_bytes())) };
    let found = format!("a normal map and heights for bumps on the surface{of}");
    let warning = Error::new(found, "one of both, or another relief").hint("the heights are left out");
    Some(match &model.source {
        Some(path) => warning.file(path),
        None => warning.place("--height-map"),
    })
}
