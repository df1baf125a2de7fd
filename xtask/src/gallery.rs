//! The gallery: every scene file of the app, rendered, with what is to be seen in it.
//!
//! Titles and texts stand at the head of the scene files, as comments, so a scene and its explanation change together.
//! `cargo xtask tidy` writes the page in memory and compares it with the one in the repository.

mod header;
mod looks;

use std::fs;
use std::path::Path;

use crate::command::Outcome;
use crate::workspace;
use header::Header;
use looks::{App, Looks, in_pairs};

/// The page that the chore writes, and the folder of its pictures, as the page links to it.
const PAGE: &str = "docs/gallery.md";
const PICTURES: &str = "gallery";

/// Where the scene files lie.
const SCENES: &str = "crates/app/scenes";

/// The scenes in the order of the page, in its sections.
const SECTIONS: &[(&str, &[&str])] = &[
    ("Filters", &["floor"]),
    ("Light", &["shading", "lights", "slide"]),
    (
        "Relief",
        &[
            "bump",
            "normal-map",
            "object-normals",
            "parallax",
            "steep-parallax",
            "parallax-occlusion",
            "grazing",
            "displacement",
        ],
    ),
    ("Material", &["ambient-occlusion", "wetness", "shininess", "emissive"]),
    ("Reflection", &["reflection-lat-long", "reflection-cube", "reflection-sphere"]),
    ("All together", &["cobblestones"]),
];

/// The scenes whose single pixels matter; the pictures of the others are JPEG, a quarter as large.
const LOSSLESS: &[&str] = &["floor", "shading"];

/// What stands above the pictures.
const HEADING: &str = "\
# Gallery: what each technique does

Each picture is a scene file in [crates/app/scenes](../crates/app/scenes), drawn by the command below it, which writes
`alberti.png` unless `-o` names another file. Open one to see how it is set up; the app's
[README](../crates/app/README.md) explains every key. The textures are made by code, `cargo xtask assets`. Names such as
`surface::bump` are those of the crate `alberti_texture`, if no other is given.

All pictures and this page are made by

    cargo xtask gallery

and `cargo xtask gallery --check` says which pictures are not what the scenes look like now.
";

/// One picture.
#[derive(Debug, PartialEq, Eq)]
struct Picture<'a> {
    scene: &'a str,
    /// What the command line adds to the scene, if anything.
    options: &'a str,
}

impl Picture<'_> {
    /// The file's name: the scene's, and the values of the options.
    fn file(&self) -> String {
        let values = self.options.split_whitespace().skip(1).step_by(2);
        let name = values.fold(self.scene.to_string(), |name, value| format!("{name}-{value}"));
        let extension = if LOSSLESS.contains(&self.scene) { "png" } else { "jpg" };
        format!("{}.{extension}", name.replace([':', ','], "-"))
    }

    /// The arguments of the app.
    fn arguments(&self) -> Vec<String> {
        let scene = format!("{SCENES}/{}.toml", self.scene);
        let options = self.options.split_whitespace().map(str::to_string);
        ["render".to_string(), scene].into_iter().chain(options).collect()
    }
}

/// Renders the scenes whose names contain the argument, or all, and writes the page. `--check` renders all of them
/// small, and says which pictures are not what the scenes look like now.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    let filter = match arguments {
        [] => "",
        [option] if option == "--check" => return check(),
        [filter] => filter,
        _ => return Err(format!("expected at most one name, found `{}`", arguments.join(" "))),
    };
    let scenes = read()?;
    let app = App::build()?;
    let root = workspace::root();
    let folder = root.join(Path::new(PAGE).with_file_name(PICTURES));
    fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let all = all(&scenes);
    let mut looks = Looks::read()?;
    let chosen: Vec<&Picture<'_>> = all.iter().filter(|picture| picture.scene.contains(filter)).collect();
    for (picture, look) in chosen.iter().zip(in_pairs(&chosen, |picture| app.draw(picture, &folder))?) {
        looks.set(&picture.file(), look);
    }
    looks.keep(&all.iter().map(Picture::file).collect::<Vec<_>>());
    looks.write()?;
    let page = page(&scenes);
    fs::write(root.join(PAGE), page).map_err(|error| format!("cannot write {PAGE}: {error}"))?;
    println!("Wrote {PAGE}.");
    Ok(())
}

/// # Errors
/// A picture is not current.
pub(crate) fn check() -> Outcome {
    let (scenes, app, looks) = (read()?, App::build()?, Looks::read()?);
    let all = all(&scenes);
    let now = in_pairs(&all.iter().collect::<Vec<_>>(), |picture| app.look(picture))?;
    let stale = all.iter().zip(now).filter(|(picture, look)| looks.of(&picture.file()) != Some(look));
    let stale: Vec<String> = stale.map(|(picture, _)| picture.file()).collect();
    if stale.is_empty() {
        println!("The gallery's {} pictures are current.", all.len());
        return Ok(());
    }
    Err(format!("not current: {}; `cargo xtask gallery` renders them anew", stale.join(", ")))
}

fn all<'a>(scenes: &'a [Section]) -> Vec<Picture<'a>> {
    scenes.iter().flat_map(|(_, scenes)| scenes).flat_map(|(scene, header)| pictures(scene, header)).collect()
}

/// What is wrong with the page and its pictures among `files`, all that the repository has: as (file, message).
pub(crate) fn problems(files: &[String]) -> Result<Vec<(String, String)>, String> {
    let mut problems = listing(files);
    if problems.is_empty() {
        let scenes = read()?;
        let written = fs::read_to_string(workspace::root().join(PAGE)).unwrap_or_default();
        if written != page(&scenes) {
            let told = "not what the heads of the scene files say: `cargo xtask gallery` writes it anew";
            problems.push((PAGE.to_string(), told.to_string()));
        }
        let scenes = scenes.iter().flat_map(|(_, scenes)| scenes);
        let shown = scenes.flat_map(|(scene, header)| pictures(scene, header)).map(|picture| picture.file());
        problems.extend(missing_and_stray(&shown.collect::<Vec<_>>(), files));
    }
    Ok(problems)
}

/// The pictures that the page shows and `files` lacks, and those that `files` has and the page does not show.
fn missing_and_stray(shown: &[String], files: &[String]) -> Vec<(String, String)> {
    let mut problems = Vec::new();
    let path = |picture: &String| format!("docs/{PICTURES}/{picture}");
    for picture in shown.iter().map(path).filter(|picture| !files.contains(picture)) {
        problems
            .push((picture, "a picture of the gallery is missing: `cargo xtask gallery` renders it".into()));
    }
    let folder = path(&String::new());
    for file in files.iter().filter(|file| file.starts_with(&folder) && *file != looks::FILE) {
        if !shown.iter().any(|picture| path(picture) == *file) {
            problems.push((file.clone(), "a picture that the gallery does not show".into()));
        }
    }
    problems
}

/// The scene files that the page does not list, and those that are listed and missing.
fn listing(files: &[String]) -> Vec<(String, String)> {
    let mut problems = Vec::new();
    let listed = || SECTIONS.iter().flat_map(|(_, scenes)| scenes.iter());
    for scene in listed() {
        let file = format!("{SCENES}/{scene}.toml");
        if !files.contains(&file) {
            problems.push((file, "this scene of the gallery is missing".to_string()));
        }
    }
    for file in files {
        let scene = file.strip_prefix(SCENES).and_then(|name| name.strip_prefix('/')?.strip_suffix(".toml"));
        if scene.is_some_and(|scene| listed().all(|known| *known != scene)) {
            let told = "this scene is missing in the list of xtask/src/gallery.rs";
            problems.push((file.clone(), told.to_string()));
        }
    }
    problems
}

/// A section's name and its scenes, each with what its file says of it.
type Section = (&'static str, Vec<(&'static str, Header)>);

fn read() -> Result<Vec<Section>, String> {
    let header = |scene: &&'static str| {
        let file = format!("{SCENES}/{scene}.toml");
        let text = fs::read_to_string(workspace::root().join(&file))
            .map_err(|error| format!("cannot read {file}: {error}"))?;
        Ok((*scene, Header::read(&text).map_err(|message| format!("{file}: {message}"))?))
    };
    let section = |(name, scenes): &(&'static str, &'static [&'static str])| {
        Ok((*name, scenes.iter().map(header).collect::<Result<_, String>>()?))
    };
    SECTIONS.iter().map(section).collect()
}

fn pictures<'a>(scene: &'a str, header: &'a Header) -> impl Iterator<Item = Picture<'a>> {
    header.pictures.iter().map(move |(options, _)| Picture { scene, options })
}

fn page(scenes: &[Section]) -> String {
    let mut page = HEADING.to_string();
    for (section, scenes) in scenes {
        page.push_str(&format!("\n## {section}\n"));
        for (scene, header) in scenes {
            page.push_str(&format!("\n### {}\n", header.title));
            for (picture, (options, text)) in pictures(scene, header).zip(&header.pictures) {
                let what = if options.is_empty() { &header.title } else { options };
                let (file, command) = (picture.file(), picture.arguments().join(" "));
                page.push_str(&format!("\n![{what}]({PICTURES}/{file})\n\n{text}\n"));
                page.push_str(&format!("\n    cargo run --release -- {command}\n"));
            }
        }
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_named_after_their_options() {
        let picture = |scene, options| Picture { scene, options }.file();
        assert_eq!(picture("bump", ""), "bump.jpg");
        assert_eq!(picture("floor", "--filter anisotropic:16"), "floor-anisotropic-16.png");
        assert_eq!(picture("bump", "--height-range 0,1 --shading phong"), "bump-0-1-phong.jpg");
    }

    #[test]
    fn a_scene_is_listed_and_a_listed_one_exists() {
        let listed = SECTIONS.iter().flat_map(|(_, scenes)| scenes.iter());
        let mut files: Vec<String> = listed.map(|scene| format!("{SCENES}/{scene}.toml")).collect();
        assert_eq!(listing(&files), []);
        files[0] = format!("{SCENES}/stray.toml");
        let found: Vec<String> = listing(&files).into_iter().map(|(file, _)| file).collect();
        assert_eq!(found, [format!("{SCENES}/floor.toml"), format!("{SCENES}/stray.toml")]);
    }

    #[test]
    fn a_picture_is_shown_and_a_shown_one_exists() {
        let shown = ["a.png".to_string(), "b.jpg".to_string()];
        let files = ["docs/gallery.md", "docs/gallery/b.jpg", "docs/gallery/c.jpg"].map(str::to_string);
        let found: Vec<String> =
            missing_and_stray(&shown, &files).into_iter().map(|(file, _)| file).collect();
        assert_eq!(found, ["docs/gallery/a.png", "docs/gallery/c.jpg"]);
    }

    #[test]
    fn a_page_has_pictures_texts_and_commands() {
        let text = "# Tea\n#\n# Hot.\n#\n# With `--wrap clamp`: cold.\n";
        let scenes = [("Drinks", vec![("tea", Header::read(text).unwrap())])];
        let (_, pictures) =
            page(&scenes).split_once("now.\n\n## ").map(|(a, b)| (a.len(), b.to_string())).unwrap();
        assert_eq!(
            pictures,
            "Drinks\n\n### Tea\n\n![Tea](gallery/tea.jpg)\n\nHot.\n\n    \
             cargo run --release -- render crates/app/scenes/tea.toml\n\n![--wrap clamp](gallery/tea-clamp.jpg)\n\n\
             With `--wrap clamp`: cold.\n\n    \
             cargo run --release -- render crates/app/scenes/tea.toml --wrap clamp\n"
        );
    }
}
