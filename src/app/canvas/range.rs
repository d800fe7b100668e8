//! Ranges of colours that stay as they are while numbers change.

/// The range of some colours. It is set by the first complete picture of what it is `About`, and stays until it is about
/// something else or is asked to fit: a colour means the same value before and after a change of the robot.
#[derive(Clone, Debug)]
pub struct KeptRange<About> {
    about: Option<About>,
    kept: Option<[f64; 2]>,
    fitting: Option<[f64; 2]>,
}

/// Ranges whose ends differ by less than this part of their width look alike.
const ALIKE: f64 = 0.02;

impl<About> Default for KeptRange<About> {
    fn default() -> Self {
        Self { about: None, kept: None, fitting: None }
    }
}

impl<About: PartialEq + Clone> KeptRange<About> {
    /// The range to colour by, where `fitting` is the one that the values there are would have, which are all where
    /// `complete`.
    pub fn update(&mut self, about: &About, fitting: Option<[f64; 2]>, complete: bool) -> Option<[f64; 2]> {
        if self.about.as_ref() != Some(about) {
            (self.about, self.kept) = (Some(about.clone()), None);
        }
        self.fitting = fitting;
        if complete && self.kept.is_none() {
            self.kept = fitting;
        }
        self.kept.or(fitting)
    }

    /// The range that is kept, once there is one.
    pub fn kept(&self) -> Option<[f64; 2]> {
        self.kept
    }

    /// Takes the range that fits the values there are.
    pub fn fit(&mut self) {
        self.kept = self.fitting;
    }

    /// Whether a range that fits would look different.
    pub fn could_fit(&self) -> bool {
        self.kept.zip(self.fitting).is_some_and(|(kept, fitting)| {
            let alike = ALIKE * (fitting[1] - fitting[0]).abs().max(kept[1] - kept[0]);
            (0..2).any(|end| (kept[end] - fitting[end]).abs() > alike)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_stays_until_it_is_about_something_else_or_is_to_fit() {
        let mut range = KeptRange::default();
        // Until a picture is complete, the range follows it.
        assert_eq!(range.update(&"speeds", Some([3.0, 5.0]), false), Some([3.0, 5.0]));
        assert_eq!(range.update(&"speeds", Some([2.0, 6.0]), true), Some([2.0, 6.0]));
        assert_eq!(range.kept(), Some([2.0, 6.0]));
        assert!(!range.could_fit());
        assert_eq!(range.update(&"speeds", Some([2.01, 6.0]), true), Some([2.0, 6.0]));
        assert!(!range.could_fit(), "nobody would see it");
        assert_eq!(range.update(&"speeds", Some([4.0, 9.0]), true), Some([2.0, 6.0]));
        assert!(range.could_fit());
        assert_eq!(range.update(&"speeds", None, false), Some([2.0, 6.0]));
        range.update(&"speeds", Some([4.0, 9.0]), true);
        range.fit();
        assert!(!range.could_fit());
        assert_eq!(range.update(&"speeds", Some([4.5, 8.0]), true), Some([4.0, 9.0]));
        assert_eq!(range.update(&"frequencies", Some([0.1, 0.2]), false), Some([0.1, 0.2]));
        assert_eq!(range.update(&"frequencies", Some([0.1, 0.3]), true), Some([0.1, 0.3]));
    }
}
