// SPDX-License-Identifier: GPL-2.0-or-later
#include <SceneAdvance.hpp>
#include <chrono>
#include <kernel/threads.hpp>

namespace yade {

namespace {
	struct Job {
		shared_ptr<Scene> scene;
		long until;
		double seconds = 0; ///< wall time
		std::string error;
	};

	void advance(Job& job)
	{
		const auto start = std::chrono::steady_clock::now();
		try {
			while (job.scene->iter < job.until)
				job.scene->moveToNextTimeStep();
		} catch (const std::exception& problem) {
			job.error = problem.what();
		}
		job.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
	}

	/// Makes a scene YADE's current one, and the previous one again in the end. The interpreter is free meanwhile.
	class CurrentScene {
		shared_ptr<Scene> previous;
		PyThreadState* released;

	public:
		explicit CurrentScene(const shared_ptr<Scene>& next)
		        : previous(swapScene(next))
		        , released(PyEval_SaveThread())
		{
		}
		~CurrentScene()
		{
			PyEval_RestoreThread(released);
			swapScene(previous);
		}
	};
}

shared_ptr<Scene> swapScene(const shared_ptr<Scene>& next)
{
	auto& current = const_cast<shared_ptr<Scene>&>(Omega::instance().getScene());
	return std::exchange(current, next);
}

boost::python::list advanceScenes(
        const boost::python::list& scenes, const boost::python::list& steps, const shared_ptr<Scene>& idle)
{
	std::vector<Job> jobs;
	for (long k = 0; k < boost::python::len(scenes); ++k)
		jobs.push_back({ boost::python::extract<shared_ptr<Scene>>(scenes[k]),
		        boost::python::extract<long>(steps[k]), 0, "" });
	{
		const CurrentScene none(idle);
		timber::forAllLong(int(jobs.size()), [&](int k) { advance(jobs[k]); });
	}
	boost::python::list outcomes;
	for (const Job& job : jobs)
		outcomes.append(boost::python::make_tuple(job.seconds, job.error));
	return outcomes;
}

} // namespace yade
