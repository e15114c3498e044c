#!/usr/bin/env bash
# A gallery as an array of a real Slurm: two virtual nodes on this machine, one of which goes down in the middle.
# usage: tests/full/slurm.sh PROGRAM
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/full/slurm.sh PROGRAM" >&2; exit 2; }
program=$(realpath "$1")

skip() { echo "skipped: the gallery on Slurm ($1)"; exit 0; }
[ "$(id -u)" -eq 0 ] || skip "its daemons are started by root alone"
for tool in slurmctld slurmd sbatch munged; do
    command -v "$tool" > /dev/null || skip "$tool is not installed"
done

folder=$(mktemp -d)
chmod 755 "$folder"
mkdir -p "$folder"/{state,spool,log,run}
stop() {
    scontrol shutdown > /dev/null 2>&1 || true
    sleep 1
    for file in "$folder"/run/*.pid; do kill "$(cat "$file")" 2> /dev/null || true; done
    # Daemons may still be writing their last lines.
    rm -rf "$folder" 2> /dev/null || { sleep 2; rm -rf "$folder"; }
}
trap stop EXIT

dd if=/dev/urandom of="$folder/munge.key" bs=1 count=1024 2> /dev/null
chmod 400 "$folder/munge.key"
munged --key-file="$folder/munge.key" --socket="$folder/run/munge.socket" --pid-file="$folder/run/munged.pid" \
    --log-file="$folder/log/munged.log" --seed-file="$folder/munge.seed" || skip "munged does not start here"
host=$(hostname)
cat > "$folder/slurm.conf" << END
ClusterName=loop
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/run/munge.socket
CryptoType=crypto/munge
SlurmctldPort=16817
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool/%n
SlurmctldPidFile=$folder/run/slurmctld.pid
SlurmdPidFile=$folder/run/slurmd-%n.pid
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MaxArraySize=10001
SchedulerParameters=batch_sched_delay=0,sched_interval=2,sched_min_interval=0,bf_interval=2
NodeName=n0 NodeHostname=$host NodeAddr=127.0.0.1 Port=17000 CPUs=1 RealMemory=1000
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=17001 CPUs=1 RealMemory=1000
PartitionName=main Nodes=n0,n1 Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
END
export SLURM_CONF=$folder/slurm.conf
slurmctld -f "$SLURM_CONF" > "$folder/log/start" 2>&1 || skip "slurmctld does not start here: $(tail -n 1 "$folder/log/start")"
slurmd -f "$SLURM_CONF" -N n0
slurmd -f "$SLURM_CONF" -N n1
for _ in $(seq 30); do
    [ "$(sinfo -h -N -t idle 2> /dev/null | wc -l)" -eq 2 ] && break
    sleep 1
done
[ "$(sinfo -h -N -t idle | wc -l)" -eq 2 ] || { sinfo -N; echo "the nodes of Slurm do not come up"; exit 1; }

cd "$folder"
gallery=(gallery koch-island koch-curve dragon-edges islands-and-lakes --set 'angle increment=60:109.5:0.5' -f png
    --size 100x100mm --dpi 150)
"$program" -q "${gallery[@]}" -o single
"$program" "${gallery[@]}" -o array --slurm 8
sleep 2
scontrol update NodeName=n1 State=DOWN Reason=test
restarted=
for _ in $(seq 240); do
    [ -n "$(squeue -h -o %i)" ] || break
    # A task that was on the node begins again on the other.
    squeue -h -r -o %i | while read -r task; do scontrol show job "$task" 2> /dev/null; done |
        grep -q 'Restarts=[1-9]' && restarted=yes
    sleep 1
done
[ -z "$(squeue -h -o %i)" ] || { squeue; tail -n 5 array.*.log; echo "the jobs do not end"; exit 1; }
[ -n "$restarted" ] || echo "(no task was on the node that went down)"
[ "$(find array -name '*.png' | wc -l)" -eq 400 ] || { tail -n 5 array.*.log; echo "not all prints are there"; exit 1; }
diff -r single array || { echo "the gallery of the array is not that of the single run"; exit 1; }
echo "slurm: 400 jobs in 8 parts on two nodes, one of which went down: as in a single run${restarted:+, a task began again}"
