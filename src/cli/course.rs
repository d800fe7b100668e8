//! The path that `fly` and `limits` are about: the scenario's own, or that of the options.

use std::path::PathBuf;

use crate::cli::streams::{file_name, read_scenario};
use crate::robot::{Robot, Trajectory};
use crate::scenario::{Corners, Path, ProfileKind, Scenario, file, trajectory};

/// The options of a path.
#[derive(Debug, clap::Args)]
pub(super) struct CourseArgs {
    /// The scenario file (JSON); - reads standard input.
    pub file: PathBuf,
    /// A point of the path, in m; several are passed in turn. In place of the scenario's own path.
    #[arg(long, value_name = "X,Y", value_parser = pair, allow_hyphen_values = true)]
    to: Vec<[f64; 2]>,
    /// What happens where legs of the path meet.
    #[arg(long, value_enum)]
    corners: Option<CornersArg>,
    /// A table t,x,y (s, m) in place of a path: a cubic spline in time, at rest at both ends.
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["to", "corners"])]
    pub trajectory: Option<PathBuf>,
}

/// The options of a motion profile.
#[derive(Debug, clap::Args)]
pub(super) struct ProfileArgs {
    /// The motion profile; the scenario's own, or quintic.
    #[arg(long, value_enum, conflicts_with = "trajectory")]
    profile: Option<ProfileArg>,
    /// The profile's peak speed in m/s; the scenario's own, or that of its motion.
    #[arg(long, value_name = "V", value_parser = positive, allow_hyphen_values = true, conflicts_with = "trajectory")]
    speed: Option<f64>,
    /// The acceleration of a trapezoid or an S-curve, in m/s²; the scenario's own, or 1.
    #[arg(long, value_name = "A", value_parser = positive, allow_hyphen_values = true, conflicts_with = "trajectory")]
    acceleration: Option<f64>,
    /// The jerk of an S-curve, in m/s³; the scenario's own, or 10.
    #[arg(long, value_name = "J", value_parser = positive, allow_hyphen_values = true, conflicts_with = "trajectory")]
    jerk: Option<f64>,
    /// How long the flight goes on after the end of the move, in s; the scenario's own, or 0.
    #[arg(long, value_name = "S", value_parser = not_negative, allow_hyphen_values = true)]
    hold: Option<f64>,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum CornersArg {
    /// Straight from point to point, at rest in each.
    Stop,
    /// Along a cubic spline through all points.
    Smooth,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum ProfileArg {
    Quintic,
    Trapezoid,
    Scurve,
    Constant,
}

/// A robot and where it is to go.
pub(super) struct Course {
    /// With the path of the options in it.
    pub scenario: Scenario,
    /// Checked.
    pub robot: Robot,
    /// Of the path, or of a table.
    pub trajectory: Trajectory,
    /// How long a flight goes on after its end, in s.
    pub hold: f64,
}

impl CourseArgs {
    /// Reads the files and puts the options in the place of what is there.
    pub(super) fn read(
        &self,
        profile: Option<&ProfileArgs>,
        input: &mut dyn std::io::Read,
    ) -> Result<Course, Vec<String>> {
        let mut scenario = read_scenario(&self.file, input)?;
        if let Some(table) = &self.trajectory {
            let fault = |what: &dyn std::fmt::Display| format!("{}: {what}", table.display());
            let text = file::open(table).map_err(|error| vec![fault(&error)])?;
            let read = trajectory::from_csv(&text);
            let trajectory = read.map_err(|faults| faults.list().iter().map(|one| fault(one)).collect::<Vec<_>>())?;
            scenario.path = None;
            let (robot, _) = scenario.to_robot().map_err(|faults| vec![faults.to_string()])?;
            let hold = profile.and_then(|profile| profile.hold).unwrap_or(0.0);
            return Ok(Course { scenario, robot, trajectory, hold });
        }
        if !self.to.is_empty() {
            let default = Path::new(Vec::new(), scenario.motion.speed);
            let path = scenario.path.take().unwrap_or(default);
            scenario.path = Some(Path { points: self.to.clone(), ..path });
        }
        let Some(path) = &mut scenario.path else {
            let file = file_name(&self.file);
            return Err(vec![format!(
                "{file}: the scenario has no path; give one with --to X,Y or --trajectory FILE.csv"
            )]);
        };
        if let Some(corners) = self.corners {
            path.corners = match corners {
                CornersArg::Stop => Corners::Stop,
                CornersArg::Smooth => Corners::Smooth,
            };
        }
        if let Some(profile) = profile {
            profile.apply(path);
        }
        let hold = path.hold;
        let lines = |faults: crate::robot::Faults| faults.list().iter().map(ToString::to_string).collect::<Vec<_>>();
        let (robot, _) = scenario.to_robot().map_err(lines)?;
        let trajectory = scenario.trajectory().ok_or_else(|| vec!["path: no way to go".to_owned()])?;
        Ok(Course { scenario, robot, trajectory, hold })
    }
}

impl ProfileArgs {
    fn apply(&self, path: &mut Path) {
        if let Some(profile) = self.profile {
            path.profile = match profile {
                ProfileArg::Quintic => ProfileKind::Quintic,
                ProfileArg::Trapezoid => ProfileKind::Trapezoid,
                ProfileArg::Scurve => ProfileKind::Scurve,
                ProfileArg::Constant => ProfileKind::Constant,
            };
        }
        for (option, place) in [
            (self.speed, &mut path.speed),
            (self.acceleration, &mut path.acceleration),
            (self.jerk, &mut path.jerk),
            (self.hold, &mut path.hold),
        ] {
            *place = option.unwrap_or(*place);
        }
    }
}

/// Two finite numbers X,Y.
pub(super) fn pair(text: &str) -> Result<[f64; 2], String> {
    let numbers = text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    let numbers = numbers.filter(|pair: &[f64; 2]| pair.iter().all(|number| number.is_finite()));
    numbers.ok_or_else(|| "allowed: two finite numbers X,Y".into())
}

/// A finite number greater than 0.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| "allowed: a finite number greater than 0".into())
}

/// A finite number, 0 or more.
pub(super) fn not_negative(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
    number.ok_or_else(|| "allowed: a finite number, 0 or more".into())
}
