#!/usr/bin/env bash
# A sweep as an array of Slurm jobs, one shard each. Change the lines below to your own, then: sbatch docs/slurm_sweep.sh
#SBATCH --job-name=tautline
#SBATCH --array=1-100
#SBATCH --cpus-per-task=4
#SBATCH --mem-per-cpu=500M
#SBATCH --time=01:00:00
#SBATCH --output=slurm-%A_%a.log
set -euo pipefail

scenario=robot.json
sweep=(--set 'platform.mass=1:4:61' --set 'motion.position[0]=-7:7:141')
parts=parts

# The array's last number, so that the shards of an array that was sent again in part are those of the whole.
shards=${SHARDS:-100}
shard=$SLURM_ARRAY_TASK_ID
mkdir -p "$parts"
part=$parts/part-$(printf '%05d' "$shard").csv

# A part gets its name once it is whole: a file that is there is done.
tautline sweep "$scenario" "${sweep[@]}" --csv --shard "$shard/$shards" \
    --threads "${SLURM_CPUS_PER_TASK:-1}" > "$part.unfinished"
mv "$part.unfinished" "$part"
