//! Parts in a folder: whole, torn, missing and mixed ones.

use super::*;
use crate::axes;

/// A folder that is empty at first, and deleted at last.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("alberti-extremes-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A sweep of one axis, for a few milliseconds.
fn sweep(seed: u64, effort: Effort) -> Sweep {
    let axes = axes::all().into_iter().filter(|axis| axis.name == "angles").collect();
    Sweep { axes, seed, effort }
}

fn shard(number: u64, of: u64) -> Shard {
    Shard { number, of }
}

#[test]
fn parts_are_written_once_and_make_the_whole() {
    let Folder(path) = &Folder::new("whole");
    let sweep = sweep(3, Effort::SMALL);
    for number in [3, 1, 2] {
        let (file, written) = write(&sweep, shard(number, 3), path).expect("a part");
        assert!(written && file.ends_with(format!("part-{number}-of-3.txt")));
    }
    assert_eq!(write(&sweep, shard(2, 3), path).map(|(_, written)| written), Ok(false));
    let (found, results) = merged(path, self::sweep).expect("three parts");
    assert!(found.seed == 3 && results == sweep.shard(Shard::WHOLE));
    assert_eq!(fs::read_dir(path).expect("the folder").count(), 3, "something else was left there");
}

#[test]
fn a_torn_part_is_no_part() {
    let Folder(path) = &Folder::new("torn");
    let sweep = sweep(3, Effort::SMALL);
    let (file, _) = write(&sweep, Shard::WHOLE, path).expect("a part");
    let text = fs::read_to_string(&file).expect("the part");
    for end in [text.len() - 5, text.len() / 2, 10] {
        fs::write(&file, &text[..end]).expect("the part");
        let message = merged(path, self::sweep).expect_err("a torn part");
        assert!(message.contains("part-1-of-1.txt:") && message.contains("delete"), "{message}");
        assert_eq!(write(&sweep, Shard::WHOLE, path).map(|(_, written)| written), Ok(true));
        assert_eq!(fs::read_to_string(&file).expect("the part"), text);
    }
}

#[test]
fn missing_and_mixed_parts_are_told() {
    let Folder(path) = &Folder::new("mixed");
    let message = || merged(path, self::sweep).expect_err("no whole sweep");
    assert!(message().contains("cannot read"));
    fs::create_dir_all(path).expect("a folder");
    assert!(message().contains("no part"));
    let (first, other) = (sweep(3, Effort::SMALL), sweep(4, Effort::SMALL));
    write(&first, shard(2, 4), path).expect("a part");
    assert!(message().contains("missing: 1, 3, 4;"), "{}", message());
    write(&other, shard(1, 4), path).expect("a part");
    assert!(message().contains("different sweeps") && message().contains("seed 0x4"), "{}", message());
    let again = write(&first, shard(1, 4), path).expect_err("another sweep's part");
    assert!(again.contains("part-1-of-4.txt has `extremes seed 0x4"), "{again}");
    fs::remove_file(path.join("part-1-of-4.txt")).expect("the part");
    write(&first, shard(1, 2), path).expect("a part");
    assert!(message().contains("shard 1/2") && message().contains("shard 2/4"), "{}", message());
}
