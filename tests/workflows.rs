//! What the workflows of the repository hold to. A line of YAML is read as text; that is enough for what is asked here.

use std::fs;
use std::path::PathBuf;

/// The files in .github/workflows, with their names.
fn workflows() -> Vec<(String, String)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(".github/workflows");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let all: Vec<_> = files.map(|file| (file.display().to_string(), fs::read_to_string(&file).unwrap())).collect();
    assert!(!all.is_empty());
    all
}

/// The lines that are indented below `line`, which is one of those of `text`.
fn below<'a>(text: &'a str, line: &str) -> Vec<&'a str> {
    let depth = |line: &str| line.len() - line.trim_start().len();
    let mut lines = text.lines().skip_while(|other| *other != line);
    let begin = lines.next().unwrap_or_else(|| panic!("no line {line:?}"));
    lines.take_while(|other| other.trim().is_empty() || depth(other) > depth(begin)).collect()
}

/// The jobs of a workflow: their names and their lines.
fn jobs(text: &str) -> Vec<(String, String)> {
    let all = below(text, "jobs:").join("\n");
    let heads = all.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   ") && line.ends_with(':'));
    heads.map(|head| (head.trim().trim_end_matches(':').into(), below(&all, head).join("\n"))).collect()
}

/// A tag can be moved to another commit by whoever owns the action; a commit cannot.
#[test]
fn actions_are_pinned_to_a_commit_and_name_their_version() {
    let mut pinned = 0;
    for (file, text) in workflows() {
        for line in text.lines().map(|line| line.trim_start().trim_start_matches("- ")) {
            let Some(action) = line.strip_prefix("uses:") else { continue };
            let (_, version) = action.split_once('@').unwrap_or_else(|| panic!("{file}: {line} has no version"));
            let (commit, comment) = version.split_once(" # v").unwrap_or_else(|| panic!("{file}: {line}"));
            assert!(commit.len() == 40 && commit.chars().all(|c| c.is_ascii_hexdigit()), "{file}: {line}");
            assert!(comment.starts_with(|c: char| c.is_ascii_digit()), "{file}: {line}");
            pinned += 1;
        }
    }
    assert!(pinned > 0);
}

#[test]
fn each_job_has_the_rights_that_it_needs_and_no_more() {
    for (file, text) in workflows() {
        assert!(text.lines().any(|line| line == "permissions: {}"), "{file}: rights for every job");
        for (name, job) in jobs(&text) {
            let rights: Vec<&str> = below(&job, "    permissions:").iter().map(|line| line.trim()).collect();
            let allowed: &[&str] = match name.as_str() {
                "publish" => &["pages: write", "id-token: write"],
                "draft" => &["actions: read", "contents: write"],
                _ => &["contents: read"],
            };
            assert_eq!(rights, allowed, "{file}: {name}");
            if allowed.iter().any(|right| right.ends_with("write")) {
                // A job that may write runs nothing of this repository, nor of its dependencies.
                assert!(!job.contains("actions/checkout@"), "{file}: {name} has a copy of the repository");
                let mut runs =
                    job.lines().filter_map(|line| line.trim_start().trim_start_matches("- ").strip_prefix("run:"));
                assert!(runs.all(|run| run.starts_with(" gh ")), "{file}: {name} runs a program");
            }
        }
        // Later steps cannot read the token that the checkout used.
        assert_eq!(
            text.matches("actions/checkout@").count(),
            text.matches("persist-credentials: false").count(),
            "{file}"
        );
    }
}

#[test]
fn pages_are_published_only_of_what_the_checks_have_passed() {
    let mut published = 0;
    for (file, text) in workflows() {
        for (name, job) in jobs(&text) {
            let at = |what: &str| job.find(what);
            if at("actions/deploy-pages@").is_some() {
                published += 1;
                assert!(job.contains("    needs: checks\n"), "{file}: {name} does not wait for the checks");
                assert!(job.contains("    if: github.ref == 'refs/heads/main'"), "{file}: {name} publishes any branch");
            }
            // What is published is what the tests have tried, not what another build makes.
            if let Some(upload) = at("actions/upload-pages-artifact@") {
                assert!(at("run: bash tests/run.sh").is_some_and(|tests| tests < upload), "{file}: {name}");
            }
        }
    }
    assert_eq!(published, 1);
}

/// The oldest compiler that Cargo.toml allows is the one that everything is tested with.
#[test]
fn the_compiler_is_the_oldest_that_is_allowed() {
    let oldest = format!("{} ", env!("CARGO_PKG_RUST_VERSION"));
    let mut installed = 0;
    for (file, text) in workflows() {
        for (_, version) in text.lines().filter_map(|line| line.split_once("rustup toolchain install ")) {
            assert!(version.starts_with(&oldest), "{file}: Rust {version}, not {oldest}");
            installed += 1;
        }
    }
    assert!(installed > 0);
}

/// A release is drafted after all else has succeeded, of tags alone, and of nothing that a cache has kept.
#[test]
fn a_release_waits_for_the_checks_and_uses_no_cache() {
    let mut drafts = 0;
    for (file, text) in workflows() {
        let jobs = jobs(&text);
        for (_, job) in jobs.iter().filter(|(_, job)| job.contains("gh release create")) {
            drafts += 1;
            let others: Vec<&str> =
                jobs.iter().map(|(name, _)| name.as_str()).filter(|name| *name != "draft").collect();
            assert!(job.contains(&format!("    needs: [{}]\n", others.join(", "))), "{file}: {others:?}");
            assert_eq!(below(&text, "on:"), ["  push:", "    tags: [\"v*\"]"], "{file}");
            assert!(!text.contains("cache@") && !text.contains("cache:"), "{file} uses a cache");
        }
    }
    assert_eq!(drafts, 1);
}
