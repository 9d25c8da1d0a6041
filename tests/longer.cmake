# Tests of fast files that take more than a second and a half of a processor: `./run test` has them, `./run test -L fast`, which is to
# stay under a minute, does not. (ctest says nothing of names that no test has; the test of the tree does.)
set_tests_properties(
  driver.Budget.fine_errs_less_than_base_from_far_and_near
  driver.CulledFrames.AreTheFramesWithout
  driver.CulledFrames.CostNextToNothingWhereNothingHides
  driver.EllipseOracle.EveryBeatOfRandomConfigurations
  driver.Frames.tiled_equals_untiled_bit_for_bit
  driver.PatternsOnDevice.BumpsAreWithin60DbOfGoldens
  driver.PostOnDevice.fine_is_within_57_db_of_golden
  driver.PostOnDevice.perspective_is_within_50_db_of_golden_where_radius_sets_are_many
  errors.Ranges.OfAFrameSaturateAsOftenAsTheDeviceCounts
  golden.DemoScenes.TheFireMovesAndComesBack
  mustfail.Culling.RefusesWhatTheModelRefuses
  mustfail.EverySample.RandomStreamsOfEveryClass
  mustfail.MustPass.TheBreakableDeviceWithNoFaultSelected
  mustfail.PlantedFault.IsSeenByRandomStreams
  mustfail.PostClassified.DamagedStreamsMeetTheModelsVerdict
  mustfail.PostClassified.EachEventHappensInItsCycle
  mustfail.PostClassified.FramesEqualTheModel
  mustfail.PostClassified.RandomStreamsOfEveryClass
  mustfail.PostClassified.RefusesWhatTheModelRefuses
  plan.PlanRun.AFailingCaseIsAResultAndTheOthersGoOn
  stages.Chain.AllDeviceIsTheIntegerModelBitForBit
  stages.DensityChain.AllDeviceIsTheIntegerModelBitForBit
  PROPERTIES LABELS slow)
