//! What the cards of words say. Every sentence is one that docs/theory.md bears out.

use super::word::Word;

/// What a card says.
struct Card {
    title: &'static str,
    text: &'static str,
    /// In the letters of docs/theory.md; empty where letters do not help.
    equation: &'static str,
    see_also: &'static [Word],
}

impl Word {
    /// The word as a card's heading.
    pub fn title(self) -> &'static str {
        self.card().title
    }

    /// What it means, in a few sentences.
    pub fn text(self) -> &'static str {
        self.card().text
    }

    /// The first sentence of that.
    pub fn first_sentence(self) -> &'static str {
        let text = self.text();
        text.find(". ").map_or(text, |end| &text[..=end])
    }

    /// The same in letters, where they help.
    pub fn equation(self) -> Option<&'static str> {
        Some(self.card().equation).filter(|equation| !equation.is_empty())
    }

    /// Words that say more.
    pub fn see_also(self) -> &'static [Self] {
        self.card().see_also
    }

    #[expect(clippy::too_many_lines)] // A list of texts.
    fn card(self) -> Card {
        match self {
            Self::CriticalSpeed => Card {
                title: "Critical speed",
                text: "The lowest speed at which some vibration of the robot, once started, grows by itself. It holds \
                       for this pose, this direction and this damping. It is found with time frozen: good for \
                       comparing poses and designs, not a safety margin.",
                equation: "the lowest v > 0 at which max Re λ becomes positive",
                see_also: &[
                    Self::FrozenTime,
                    Self::WaveLimit,
                    Self::Flutter,
                    Self::Divergence,
                    Self::Sensitivity,
                    Self::MeshError,
                ],
            },
            Self::FrozenTime => Card {
                title: "Frozen time",
                text: "The cables' lengths change all the time, yet this criterion looks at one instant, as if they \
                       and their rates stayed what they are. It then calls every cable that is reeled in unstable, \
                       unless damping hides it. So the critical speed tells much about damping, and it is not a safety \
                       margin.",
                equation: "of one string, nearly: Re λ = −(α + v L′/L)/2",
                see_also: &[Self::CriticalSpeed, Self::WaveLimit, Self::Gain, Self::Reeling],
            },
            Self::WaveLimit => Card {
                title: "Wave limit",
                text: "The speed of the platform at which a winch reels as fast as waves run along its cable. It needs \
                       no eigenvalues and no damping. In all robots tried, vibration without bound began only beyond \
                       it; below, vibrations stay bounded, which does not mean small.",
                equation: "least c/|w| at v = 1, c = √(N/(λ μ)), |w| = |L′| (k + 1)/n",
                see_also: &[Self::CriticalSpeed, Self::FrozenTime, Self::Reeling, Self::Gain, Self::WaveRatio],
            },
            Self::WaveRatio => Card {
                title: "Wave ratio ρ of a move",
                text: "How near a move comes to the wave limit: the largest of its speed over the limit at the same place. \
                       Below 1 no vibration grew without bound in any robot tried, though it can grow by half or \
                       more. Above 1 growth has no bound.",
                equation: "ρ = max over s of v(s)/wave limit(s)",
                see_also: &[Self::WaveLimit, Self::Gain, Self::CriticalSpeed],
            },
            Self::Gain => Card {
                title: "Gain of a move",
                text: "How many times larger any vibration can be after a move than before it. At 1.2 it is at most \
                       20 % larger; below 1 every vibration ends smaller than it began. Time runs here and is not \
                       frozen. It is a number and no verdict.",
                equation: "size of a vibration: √(energy/ω), from rest to rest",
                see_also: &[Self::FrozenTime, Self::WaveRatio, Self::ModeShape],
            },
            Self::Path => Card {
                title: "Path",
                text: "The way of the platform from where it is to other points. It goes straight to each of them and rests \
                       there, or along a smooth curve through all of them. The marks across the line are at equal \
                       times: where they are far apart the platform is fast.",
                equation: "position p(s), s the length of the way so far",
                see_also: &[Self::MotionProfile, Self::WaveLimit, Self::Gain],
            },
            Self::MotionProfile => Card {
                title: "Motion profile",
                text: "How the speed rises and falls along the path. A quintic is smooth in speed and acceleration. A \
                       trapezoid has a constant acceleration, which begins and ends at once. An S-curve limits the jerk \
                       as well: how fast the acceleration changes. The smoother the profile, the less it shakes the robot.",
                equation: "quintic: s = D (10 τ³ − 15 τ⁴ + 6 τ⁵), τ = t/T, T = 15 D/(8 v)",
                see_also: &[Self::Path, Self::Gain],
            },
            Self::Flutter => Card {
                title: "Flutter",
                text: "One way to lose stability: a vibration swings to and fro, and every swing is larger than the \
                       last. Mostly a cable that is reeled in feeds it with more energy than damping takes out.",
                equation: "Re λ > 0 and f = |Im λ|/2π > 0",
                see_also: &[Self::Divergence, Self::GrowthRate, Self::ModeShape],
            },
            Self::Divergence => Card {
                title: "Divergence",
                text: "The other way to lose stability: a cable bows out further and further without swinging back. \
                       Mostly it runs about as fast as its own waves then, and its tension no longer pulls it straight.",
                equation: "Re λ > 0 and Im λ = 0; it begins where det (K_el + K_dyn) = 0",
                see_also: &[Self::Flutter, Self::WaveLimit, Self::GrowthRate],
            },
            Self::GrowthRate => Card {
                title: "Growth rate",
                text: "How fast a vibration grows, or dies out where the rate is below zero. At −0.26 1/s it loses 23 % \
                       of its size every second. The robot counts as stable while all its growth rates are below zero.",
                equation: "size ~ exp(Re λ t); it doubles in ln 2/Re λ",
                see_also: &[Self::DampingRatio, Self::Campbell, Self::CriticalSpeed],
            },
            Self::DampingRatio => Card {
                title: "Damping ratio",
                text: "How strongly a vibration is damped, measured by its own frequency. At 0 it swings for ever, at \
                       5 % every swing is about a quarter smaller than the one before, at 100 % it does not swing at \
                       all. Below 0 it grows.",
                equation: "ζ = −Re λ/|λ|",
                see_also: &[Self::GrowthRate, Self::ModeShape],
            },
            Self::ModeShape => Card {
                title: "Mode shape",
                text: "A robot vibrates in certain patterns, its modes, each with its own frequency and growth rate. \
                       Every small vibration is a sum of them. The shape tells how far each point moves against all \
                       others; how large it is drawn means nothing.",
                equation: "q = X exp(λ t)",
                see_also: &[Self::GrowthRate, Self::DampingRatio, Self::Stiffness, Self::Campbell],
            },
            Self::Stiffness => Card {
                title: "Secant and tangent stiffness",
                text: "How strongly a taut cable resists a small push. Tangent is exact: soft across the cable, far \
                       stiffer along it. Secant, the simplification of the paper, takes the soft value for both; fast \
                       waves along the cable then drop out, and x and y no longer affect each other.",
                equation: "secant (N/λ) I;  tangent (N/λ)(I − e⊗e) + (dN/dλ) e⊗e",
                see_also: &[Self::Strain, Self::ModeShape],
            },
            Self::Strain => Card {
                title: "Green's and engineering strain",
                text: "Two ways to measure how far a cable is stretched, and so two laws of its force. Stretched by \
                       1 %, a cable pulls 1.5 % harder under Green's, which the paper uses, than under engineering \
                       strain; stretched by 10 %, 15.5 % harder.",
                equation: "Green's N = EA (λ³ − λ)/2;  engineering N = EA (λ − 1)",
                see_also: &[Self::UnstretchedLength, Self::Stiffness],
            },
            Self::Holding => Card {
                title: "Holding and stiffening cables",
                text: "Two cables hold the platform: their tensions follow from the balance with its weight and with \
                       the pull of all others. The others stiffen the robot: you choose their tension, as a number or \
                       as a law of the position.",
                equation: "T = √((h0 + hx x + hy y)² + (v0 + vx x + vy y)²)",
                see_also: &[Self::Slack, Self::UnstretchedLength],
            },
            Self::UnstretchedLength => Card {
                title: "Unstretched length",
                text: "The length that a cable would have if nothing pulled at it. The winch sets this length; tension \
                       then stretches it by the factor λ. A cable's mass is counted per metre of it.",
                equation: "stretched length = λ L where λ is the same all along",
                see_also: &[Self::Reeling, Self::Strain],
            },
            Self::Reeling => Card {
                title: "Reeled in and paid out",
                text: "While the platform moves, each winch takes cable in or lets it out. Reeling in feeds the cable's \
                       vibration with energy and raises its frequency; paying out does the opposite.",
                equation: "dL/dt = v L′; reeled in where L′ < 0",
                see_also: &[Self::Path, Self::UnstretchedLength, Self::WaveLimit, Self::FrozenTime, Self::Holding],
            },
            Self::Slack => Card {
                title: "Slack",
                text: "A cable can pull but not push: instead it goes slack. Where balance would need a push, the pose \
                       has no equilibrium. Starting or braking hard can make a cable slack as well, which this analysis \
                       of steady motion does not see.",
                equation: "N > 0 all along a taut cable",
                see_also: &[Self::Holding, Self::UnstretchedLength],
            },
            Self::Campbell => Card {
                title: "Speed diagram",
                text: "All vibrations of the robot over its speed: how often each swings, and how fast it grows or dies \
                       out. The first that begins to grow sets the critical speed. Engineers call such pictures \
                       Campbell diagrams; turbines have them too.",
                equation: "",
                see_also: &[Self::GrowthRate, Self::ModeShape, Self::CriticalSpeed],
            },
            Self::MeshError => Card {
                title: "Mesh error",
                text: "Each cable is computed as a chain of straight pieces, so the answer is a little off. Finer \
                       chains tell how far: those digits are shown that do not depend on the number of pieces.",
                equation: "error ~ 1/n² for flutter, 1/n for divergence",
                see_also: &[Self::CriticalSpeed, Self::Divergence],
            },
            Self::Sensitivity => Card {
                title: "Sensitivity",
                text: "By how many percent the critical speed changes when one number of the robot grows by one percent \
                       and all others stay. The largest ones tell which number to turn. They hold for small changes \
                       only.",
                equation: "(p/v) dv/dp, v the critical speed",
                see_also: &[Self::CriticalSpeed, Self::Campbell],
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_word_has_a_short_text_of_its_own() {
        let mut told = HashSet::new();
        for word in Word::ALL {
            let count = word.text().split_whitespace().count();
            assert!((15..=60).contains(&count), "{word:?}: {count} words");
            assert!(word.text().ends_with('.'), "{word:?}");
            assert!(told.insert(word.title()) && told.insert(word.text()), "{word:?} repeats another");
            assert!(word.title().chars().count() <= 30, "{word:?}: the heading fills more than a line");
            let first = word.first_sentence();
            assert!(first.ends_with('.') && first.len() < word.text().len(), "{word:?}: {first}");
            assert!(!first.contains(". "), "{word:?}: {first}");
            assert!(word.equation() != Some(""));
        }
        assert_eq!(Word::ALL.iter().collect::<HashSet<_>>().len(), Word::ALL.len());
    }

    #[test]
    fn from_the_critical_speed_links_lead_to_all_words_and_none_to_itself() {
        let mut seen = vec![Word::CriticalSpeed];
        let mut next = 0;
        while let Some(word) = seen.get(next).copied() {
            next += 1;
            let links = word.see_also();
            assert!(!links.contains(&word), "{word:?}");
            assert_eq!(links.iter().collect::<HashSet<_>>().len(), links.len(), "{word:?}");
            seen.extend(links.iter().filter(|link| !seen.contains(link)).copied().collect::<Vec<_>>());
        }
        assert_eq!(seen.len(), Word::ALL.len(), "{seen:?}");
    }

    /// The numbers in the texts, from the equations that stand below them.
    #[test]
    fn the_numbers_told_are_right() {
        let lost = 1.0 - (-0.26_f64).exp();
        assert!((100.0 * lost - 23.0).abs() < 0.5, "{lost}");
        let zeta: f64 = 0.05;
        let smaller = 1.0 - (-std::f64::consts::TAU * zeta / (1.0 - zeta * zeta).sqrt()).exp();
        assert!((0.24..0.28).contains(&smaller), "{smaller}");
        let green = |stretch: f64| 0.5 * (stretch.powi(3) - stretch) / (stretch - 1.0);
        assert!((green(1.01) - 1.015).abs() < 5e-4 && (green(1.1) - 1.155).abs() < 5e-4);
    }
}
