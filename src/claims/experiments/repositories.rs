//! Files of public repositories at one commit each: all those whose names the chapter gives, found by
//! `git ls-tree -r --name-only <commit>`, wherever they stand.

/// What a repository holds at a commit.
#[derive(Clone, Copy, Debug)]
pub struct Tree {
    files: &'static [&'static str],
}

impl Tree {
    /// Whether there is a file at this path from the root.
    pub fn has(&self, path: &str) -> bool {
        self.has_below("", path)
    }

    /// Whether there is a file at this path from a folder, which ends in `/` or is the root.
    pub fn has_below(&self, folder: &str, path: &str) -> bool {
        self.files.iter().any(|file| file.strip_prefix(folder) == Some(path))
    }

    /// How many of these paths from the root there are.
    pub fn count(&self, paths: &[&str]) -> usize {
        paths.iter().filter(|path| self.has(path)).count()
    }

    /// How many of these file names there are, in whatever folder.
    pub fn count_named(&self, names: &[&str]) -> usize {
        names.iter().filter(|name| self.files.iter().any(|file| file.rsplit('/').next() == Some(**name))).count()
    }

    /// How many of the files end like this and stand below a folder.
    pub fn count_ending(&self, folder: &str, end: &str) -> usize {
        self.files.iter().filter(|file| file.starts_with(folder) && file.ends_with(end)).count()
    }
}

/// Siconos, tag 4.4.0 of September 2021. Here and in the later ones the files of Frémond's law were looked for as well.
pub const SICONOS_440: Tree = Tree {
    files: &[
        "kernel/src/simulationTools/MoreauJeanOSI.cpp",
        "numerics/src/FrictionContact/fc3d_nonsmooth_Newton_AlartCurnier.c",
        "numerics/src/FrictionContact/fc3d_nsgs.c",
        "numerics/src/FrictionContact/gfc3d_ipm.c",
    ],
};

/// Siconos, tag 4.5.0 of March 2024.
pub const SICONOS_450: Tree = Tree {
    files: &[
        "kernel/src/modelingTools/FremondImpactFrictionNSL.cpp",
        "kernel/src/modelingTools/FremondImpactFrictionNSL.hpp",
        "kernel/src/simulationTools/MoreauJeanOSI.cpp",
        "numerics/src/FrictionContact/fc3d_nonsmooth_Newton_AlartCurnier.c",
        "numerics/src/FrictionContact/fc3d_nsgs.c",
        "numerics/src/FrictionContact/gfc3d_ipm.c",
    ],
};

/// Siconos's main branch at 6070f0f6 of August 2026.
pub const SICONOS_2026: Tree = Tree {
    files: &[
        "kernel/src/modeling/FremondImpactFrictionNSL.cpp",
        "kernel/src/modeling/FremondImpactFrictionNSL.hpp",
        "kernel/src/simulation/MoreauJeanOSI.cpp",
        "numerics/src/FrictionContact/fc3d_nsgs.c",
        "numerics/src/FrictionContact/gfc3d_ipm.c",
        "numerics/src/FrictionContact/nsn_formulation/fc3d_nonsmooth_Newton_AlartCurnier.c",
    ],
};

/// Drake's main branch at be259df7 of August 2026.
pub const DRAKE: Tree = Tree { files: &["multibody/contact_solvers/sap/sap_solver.cc", "multibody/plant/tamsi_solver.cc"] };

/// MuJoCo's main branch at a7255075 of August 2026.
pub const MUJOCO: Tree = Tree {
    files: &[
        "mjx/mujoco/mjx/_src/solver.py",
        "mjx/mujoco/mjx/third_party/mujoco_warp/_src/solver.py",
        "src/engine/engine_core_constraint.c",
        "src/engine/engine_solver.c",
    ],
};

/// The functions that `engine_solver.c` exports there.
pub const MUJOCO_SOLVERS: [&str; 8] = [
    "mj_solPGS",
    "mj_solPGS_island",
    "mj_solNoSlip",
    "mj_solNoSlip_island",
    "mj_solCG",
    "mj_solCG_island",
    "mj_solNewton",
    "mj_solNewton_island",
];

/// Chrono's main branch at 7689fbc0 of August 2026: every `ChSolver*.cpp`, and every `.cu`, a source for a GPU, but those of fluids and
/// sensors.
pub const CHRONO: Tree = Tree {
    files: &[
        "src/chrono/solver/ChSolver.cpp",
        "src/chrono/solver/ChSolverADMM.cpp",
        "src/chrono/solver/ChSolverAPGD.cpp",
        "src/chrono/solver/ChSolverBB.cpp",
        "src/chrono/solver/ChSolverPJacobi.cpp",
        "src/chrono/solver/ChSolverPSOR.cpp",
        "src/chrono_dem/gpu/ChDemSMC.cu",
        "src/chrono_dem/gpu/ChDemSMCtrimesh.cu",
        "src/chrono_matlab/ChSolverMatlab.cpp",
        "src/chrono_multicore/solver/ChSolverMulticore.cpp",
        "src/chrono_multicore/solver/ChSolverMulticoreAPGD.cpp",
        "src/chrono_multicore/solver/ChSolverMulticoreAPGDREF.cpp",
        "src/chrono_multicore/solver/ChSolverMulticoreBB.cpp",
        "src/chrono_multicore/solver/ChSolverMulticoreCG.cpp",
        "src/chrono_multicore/solver/ChSolverMulticoreGS.cpp",
        "src/chrono_multicore/solver/ChSolverMulticoreJacobi.cpp",
        "src/chrono_multicore/solver/ChSolverMulticoreMINRES.cpp",
        "src/chrono_multicore/solver/ChSolverMulticoreSPGQP.cpp",
        "src/chrono_mumps/ChSolverMumps.cpp",
        "src/chrono_pardisomkl/ChSolverPardisoMKL.cpp",
    ],
};

/// Pinocchio, tag v2.7.0: none of the files.
pub const PINOCCHIO_2: Tree = Tree { files: &[] };

/// What an ADMM solver of v2.7.0 takes: it has none.
pub const PINOCCHIO_2_TAKES: [&str; 0] = [];

/// Pinocchio, tag v3.7.0 of May 2025.
pub const PINOCCHIO_3: Tree = Tree {
    files: &[
        "include/pinocchio/algorithm/admm-solver.hpp",
        "include/pinocchio/algorithm/admm-solver.hxx",
        "include/pinocchio/algorithm/contact-cholesky.hpp",
        "include/pinocchio/bindings/python/algorithm/contact-cholesky.hpp",
    ],
};

/// What the ADMM solver of v3.7.0 takes: its settings, and the compliance R.
pub const PINOCCHIO_3_TAKES: [&str; 6] = ["mu_prox", "tau", "rho_power", "rho_power_factor", "ratio_primal_dual", "R"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_asked_from_its_folder_on_and_not_in_part() {
        assert!(MUJOCO.has("src/engine/engine_solver.c") && !MUJOCO.has("engine_solver.c"));
        assert!(MUJOCO.has_below("mjx/mujoco/", "mjx/_src/solver.py") && !MUJOCO.has("mjx/_src/solver.py"));
        assert_eq!(MUJOCO.count_named(&["engine_solver.c", "olver.c"]), 1);
    }
}
